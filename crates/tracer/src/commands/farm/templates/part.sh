#!/bin/sh
# A part of a rendering, written by `tracer farm slurm`. Slurm starts it for each part, and again when a node has died
# or the part was preempted; it goes on from the part's own film.
folder=@FOLDER@
directory=@DIRECTORY@
program=@PROGRAM@
parts=@PARTS@
retries=@RETRIES@
pause=@PAUSE@

part=$SLURM_ARRAY_TASK_ID
film=$folder/parts/$(printf '%0@DIGITS@dof%d' "$part" "$parts").tracer
state=$folder/state/$part
node=${SLURMD_NODENAME:-$(uname -n)}
threads=${SLURM_CPUS_ON_NODE:-}
set -- @RENDER@ \
    --part "$part/$parts" --resume "$film" -o "$film" --every @EVERY@ ${threads:+--threads "$threads"}

say() {
    echo "== $(date -u +%Y-%m-%dT%H:%M:%SZ) part $part of $parts on $node: $*"
}

# A failure is a line of a file: so it is counted when Slurm starts this anew, too.
give_up() {
    say "$1; not started again"
    echo "$1 on $node" >"$state.failed"
    exit 1
}

# SIGTERM: Slurm ends the job, for a preemption, a cancellation, or its limit. USR1: the limit is near (--signal).
pid=
asked=
end() {
    asked=$1
    if [ -n "$pid" ]; then kill -TERM "$pid" 2>/dev/null; fi
}
trap 'end end' TERM
trap 'end "${asked:-time}"' USR1

# As `wait`, which a signal to this shell interrupts.
await() {
    pid=$1
    if [ -n "$asked" ]; then kill -TERM "$pid" 2>/dev/null; fi
    wait "$pid"
    code=$?
    while kill -0 "$pid" 2>/dev/null; do
        wait "$pid"
        code=$?
    done
    pid=
}

stop_if_asked() {
    case $asked in
    end)
        say 'ended by SIGTERM; what was traced is kept'
        exit 143
        ;;
    time)
        # Without progress it would go round for ever.
        [ "$film" -nt "$state.began" ] || give_up 'the time limit is too short to trace anything'
        say 'the time limit is near; what was traced is kept, and the part is queued again'
        # Slurm ends all of the job for it, and scontrol must live to say whether it was done.
        (trap '' TERM && exec scontrol requeue "${SLURM_ARRAY_JOB_ID}_$part") && exit 143
        if [ "$asked" = end ]; then exit 143; fi
        give_up 'out of time, and Slurm does not queue it again'
        ;;
    esac
}

mkdir -p "$folder/parts" "$folder/state" || exit 1
rm -f "$state.failed"
say "job ${SLURM_ARRAY_JOB_ID}_$part, started again ${SLURM_RESTART_COUNT:-0} times by Slurm"
while :; do
    : >"$state.began"
    (cd "$directory" && exec "$program" "$@") &
    await $!
    if [ "$code" -eq 0 ]; then
        : >"$state.done"
        exit 0
    fi
    # Where tracer was ended by the signal that this shell is about to get, too.
    if [ -z "$asked" ] && [ "$code" -ge 128 ]; then
        sleep 1 &
        await $!
        code=143
    fi
    stop_if_asked
    echo "exit code $code on $node" >>"$state.tries"
    tries=$(wc -l <"$state.tries")
    if [ "$tries" -gt "$retries" ]; then give_up "exit code $code, $((tries)) times"; fi
    say "exit code $code; started again in $pause s"
    sleep "$pause" &
    await $!
    stop_if_asked
done
