#!/bin/sh
# The merge of a rendering's parts, written by `tracer farm slurm`. It begins when no part waits or runs any more.
folder=@FOLDER@
directory=@DIRECTORY@
program=@PROGRAM@
parts=@PARTS@
retries=@RETRIES@
pause=@PAUSE@
threads=${SLURM_CPUS_ON_NODE:-}

say() {
    echo "== $(date -u +%Y-%m-%dT%H:%M:%SZ) merge on ${SLURMD_NODENAME:-$(uname -n)}: $*"
}

say "job $SLURM_JOB_ID"
tries=0
while :; do
    missing=
    part=1
    while [ "$part" -le "$parts" ]; do
        if [ ! -f "$folder/state/$part.done" ]; then missing="$missing $part"; fi
        part=$((part + 1))
    done
    if [ -n "$missing" ]; then
        why="not merged, for these parts are not done:$missing"
    elif (cd "$directory" && exec "$program" merge "$folder"/parts/*of"$parts".tracer @MERGE@ \
        ${threads:+--threads "$threads"}); then
        : >"$folder/state/merge.done"
        exit 0
    else
        why="tracer merge failed"
    fi
    tries=$((tries + 1))
    # A part that is done may be seen late on another machine's disk.
    if [ "$tries" -gt "$retries" ]; then
        say "$why"
        echo "$why" >"$folder/state/merge.failed"
        exit 1
    fi
    sleep "$pause"
done
