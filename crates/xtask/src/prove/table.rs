//! The long proofs by name.

use super::Need::{Cargo, File, Nightly, Program, Python};
use super::When::{Always, Asked};
use super::{Need, Proof, When};

const fn proof(
    name: &'static str,
    when: When,
    what: &'static str,
    needs: &'static [Need],
    commands: &'static [&'static str],
) -> Proof {
    Proof { name, when, what, needs, commands }
}

/// The version of mdBook.
pub const MDBOOK: &str = "0.5.4";

/// What Mitsuba needs.
const MITSUBA: &[Need] =
    &[Python(&["mitsuba==3.9.1", "numpy"]), File("/usr/lib/x86_64-linux-gnu/libLLVM-19.so", "libllvm19")];

/// A browser, and what drives it: chromium of Debian, playwright-core of npm.
const BROWSER: &[Need] = &[Program("chromium", "chromium"), Program("node", "nodejs"), Program("npm", "npm")];

/// An editor, and what the extension of another one runs in.
const EDITORS: &[Need] = &[Program("nvim", "neovim"), Program("node", "nodejs")];

/// Slurm's daemons and its keys, GNU parallel.
const SLURM: &[Need] =
    &[Program("sbatch", "slurm-wlm"), File("/usr/sbin/munged", "munge"), Program("parallel", "parallel")];

/// All of them. CONTRIBUTING.md has a row for each.
pub const PROOFS: &[Proof] = &[
    proof(
        "instructions",
        Always,
        "the instructions of the hot paths stay below their limits; four minutes",
        &[Program("valgrind", "valgrind")],
        &["cargo build --release --locked --workspace", "target/release/xtask instructions"],
    ),
    proof(
        "proofs",
        Always,
        "the tests that take more than some seconds each; thirteen minutes",
        &[],
        &["cargo test --locked --workspace --lib --tests -- --ignored"],
    ),
    proof(
        "units",
        Always,
        "the unit tests of the crates that take long to compile once more; two minutes, once `proofs` has run",
        &[],
        &["cargo test --locked --workspace --lib"],
    ),
    proof(
        "preview",
        Asked,
        "`tracer preview` in a real browser: saves, faults, keys, mouse, two pages, a phone, an hour of saves, 50 MB; \
         three minutes",
        BROWSER,
        &[
            "cargo build --locked -p tracer",
            "npm install --silent --no-audit --no-fund --no-save --prefix target/prove/node playwright-core@1.56.1",
            "node crates/preview/tests/browser/main.mjs",
        ],
    ),
    proof(
        "golden",
        Asked,
        "the page of `tracer golden` in a real browser: wipe by mouse and keys, dark and light, a phone's width, \
         nothing asked of anybody; a minute",
        BROWSER,
        &[
            "cargo build --locked -p tracer",
            "npm install --silent --no-audit --no-fund --no-save --prefix target/prove/node playwright-core@1.56.1",
            "node crates/golden/tests/browser/main.mjs",
        ],
    ),
    proof(
        "cryptomatte",
        Asked,
        "mattes as the official OpenEXR and another program's decoder of Cryptomatte read them; half a minute",
        &[Python(&["OpenEXR==3.5.3", "cryptomatte-api==1.0.0", "mmh3==5.3.1", "numpy"])],
        &["cargo build --locked -p tracer", "python crates/tracer/tests/cryptomatte/main.py"],
    ),
    proof(
        "oidn",
        Asked,
        "`--denoise oidn` with the library of PyPI's wheel: errors fall, the same bytes again, by parts and by frames; \
         half a minute",
        &[Python(&["pyoidn==2.5.1.0"])],
        &["TRACER_OIDN=$(python -c 'from importlib.util import find_spec; \
             print(find_spec(\"pyoidn\").submodule_search_locations[0] + \"/oidn\")') \
             cargo test --locked --workspace --test oidn"],
    ),
    proof(
        "musl",
        Asked,
        "the program as one static file below 16 MB, which makes every golden byte for byte, and the container with it \
         below 20 MB, which renders; ten minutes",
        &[Program("buildah", "buildah"), Program("cc", "gcc libc6-dev")],
        &["cargo xtask musl --all-pictures --container"],
    ),
    proof(
        "faults",
        Always,
        "every call to the system that concerns a file fails in one of the usual ways, blocks of memory are refused; \
         two minutes",
        &[],
        &["cargo test --locked --workspace --test faults"],
    ),
    proof(
        "package",
        Always,
        "the packages of all crates are made; ten seconds",
        &[],
        &["cargo package --workspace --no-verify --locked --allow-dirty --quiet"],
    ),
    proof(
        "pairs",
        Always,
        "scenes that must look the same, in exact pairs; four minutes",
        &[],
        &["cargo test --locked --workspace --test pairs"],
    ),
    proof(
        "random-scenes",
        Always,
        "twenty random scenes against the truth; a minute",
        &[],
        &["cargo test --locked --workspace --test truth"],
    ),
    proof(
        "schema",
        Always,
        "the JSON Schema by an independent validator: all scenes of the repository validate, broken ones do not; \
         seconds, once the program is built with `--release`",
        &[Python(&["jsonschema-rs==0.60.3"])],
        &[
            "cargo build --release --locked --workspace",
            "target/release/xtask schema-cases target/prove/schema",
            "python crates/scene-format/tests/schema/main.py target/prove/schema",
        ],
    ),
    proof(
        "python",
        Always,
        "the wheel of the module for Python: built, installed, tested by pytest, its types by mypy, the examples of \
         docs/python.md; two minutes, once the program is built with `--release`",
        &[Python(&["maturin==1.16.0", "numpy", "pytest==9.2.0", "mypy==2.4.1"]), Program("strip", "binutils")],
        &[
            "rm -rf target/prove/wheels && python -m pip wheel --quiet --disable-pip-version-check --no-deps \
             --no-build-isolation --wheel-dir target/prove/wheels crates/python",
            "python -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
             target/prove/wheels/tracer_render-*.whl",
            "python -m pytest -q -c crates/python/pyproject.toml crates/python/tests/python --pyargs tracer",
        ],
    ),
    proof(
        "editors",
        Always,
        "`tracer lsp` with Neovim, and the extension for VS Code in an editor of its own; ten seconds, once the \
         program is built with `--release`",
        EDITORS,
        &[
            "cargo build --release --locked --workspace",
            "TRACER=target/release/tracer node crates/lsp/tests/vscode/main.js",
            "TRACER=target/release/tracer nvim --clean --headless -c 'luafile crates/lsp/tests/neovim/main.lua'",
        ],
    ),
    proof(
        "site",
        Asked,
        "the manual as a site by mdBook, a picture for every entry of the reference; a minute, once mdBook is \
         installed",
        &[Cargo("mdbook", "mdbook", MDBOOK)],
        &["cargo xtask site", "grep -q img target/site/book/docs/scene-reference.html"],
    ),
    proof(
        "slurm",
        Always,
        "`tracer farm` with a Slurm of its own: nodes that die, limits, failures, and parts by GNU parallel, the same \
         bytes; a minute and a half",
        SLURM,
        &["cargo test --locked --workspace --test slurm -- --skip over_ssh"],
    ),
    // By its name alone: where it is not there yet, Debian starts the daemon that it installs.
    proof(
        "ssh",
        Asked,
        "parts by GNU parallel over an ssh of its own, the same bytes; half a minute",
        &[Program("parallel", "parallel"), File("/usr/sbin/sshd", "openssh-server")],
        &["cargo test --locked --workspace --test slurm -- over_ssh"],
    ),
    proof(
        "pairs-long",
        Asked,
        "the same pairs with four times the pictures; a quarter of an hour",
        &[],
        &["cargo xtask truth --pairs 40"],
    ),
    proof(
        "truth",
        Asked,
        "random scenes, the default picture against the plain path tracer's or that of a scene that must look the \
         same; an hour and a half",
        &[],
        &["cargo xtask truth --scenes 1000"],
    ),
    proof(
        "sweeps",
        Asked,
        "no cliffs, no pops: noise and mean while a parameter changes in forty steps, and films of 24 frames; \
         twenty minutes",
        &[],
        &["cargo xtask sweeps"],
    ),
    proof(
        "rooms",
        Asked,
        "squares in the noise of ten rooms where light is hard to find, at 4 to 256 samples; half an hour",
        &[],
        &["cargo xtask rooms"],
    ),
    proof(
        "statistics",
        Asked,
        "the statistical proofs with 16 times the samples; an hour",
        &[],
        &["TRACER_PROOFS=long cargo test --locked -p tracer-core --test proofs -- --include-ignored"],
    ),
    proof(
        "mutants",
        Asked,
        "faults seeded one at a time, of which a test must notice each; an hour",
        &[],
        &["cargo xtask mutants"],
    ),
    proof(
        "watertight",
        Asked,
        "a hundred million rays at edges and vertices; minutes",
        &[],
        &["BVH_WATERTIGHT_RAYS=100000000 cargo test --locked -p tracer-core --test bvh_watertight"],
    ),
    proof(
        "scene-mutants",
        Asked,
        "a hundred thousand broken scenes, read without a panic or a second's wait; minutes",
        &[],
        &["SCENE_MUTANTS=100000 cargo test --release --locked -p scene-format --test mutants"],
    ),
    proof(
        "scene-mistakes",
        Asked,
        "sixty sorts of human mistakes at a thousand places of each scene; minutes",
        &[],
        &["SCENE_MISTAKES=1000 cargo test --release --locked -p scene-format --test mistakes"],
    ),
    proof(
        "scene-memory",
        Asked,
        "the memory that reading takes, with files of 64 MB; minutes",
        &[],
        &["SCENE_MEMORY=64 cargo test --release --locked -p scene-format --test memory"],
    ),
    proof(
        "mesh-mutants",
        Asked,
        "half a million broken meshes, read without a panic; minutes",
        &[],
        &["TRACER_MUTANTS=500000 cargo test --release --locked -p tracer-mesh --test mesh_mutations"],
    ),
    proof(
        "film-mutants",
        Asked,
        "a million broken checkpoints and a million broken parts, read, gone on with and merged without a panic; \
         twenty minutes",
        &[],
        &[
            "FILM_MUTANTS=500000 cargo test --locked --workspace --test film_file -- --ignored mutants",
            "FILM_MUTANTS=1000000 cargo test --locked --workspace --test film_parts -- mutants",
        ],
    ),
    proof(
        "cache-mutants",
        Asked,
        "a hundred thousand broken files of a cache, damaged or sealed anew, taken without a panic; half an hour",
        &[],
        &["CACHE_MUTANTS=50000 cargo test --locked --workspace --lib -- --ignored stored"],
    ),
    proof(
        "faults-long",
        Asked,
        "every call to the system that concerns a file fails in every usual way, every large block of memory is \
         refused, disks of all sizes are full; ten minutes",
        &[],
        &["FAULTS=long cargo test --locked --workspace --test faults -- --nocapture"],
    ),
    proof(
        "soak",
        Asked,
        "renderings killed, signalled, gone on with, divided and merged at random, the same bytes; twenty minutes, or \
         TRACER_SOAK seconds",
        &[],
        &["cargo test --locked --workspace --test soak -- --nocapture"],
    ),
    proof(
        "goldens-release",
        Asked,
        "the goldens with all optimisations: the bytes are those of the profile `dev`; ten minutes",
        &[],
        &["cargo test --release --locked -p tracer --test goldens"],
    ),
    proof(
        "address-sanitizer",
        Asked,
        "the engine's tests with the address sanitizer, vector code and all; an hour",
        &[Nightly(&["rust-src"])],
        &["RUSTFLAGS=-Zsanitizer=address CARGO_TARGET_DIR=target/asan cargo +nightly test -p tracer-core \
             --target x86_64-unknown-linux-gnu"],
    ),
    proof(
        "miri",
        Asked,
        "the smallest whole rendering under Miri; a quarter of an hour",
        &[Nightly(&["miri", "rust-src"])],
        &["MIRIFLAGS='-Zmiri-disable-isolation -Zmiri-ignore-leaks -Zmiri-permissive-provenance \
             -Zmiri-disable-stacked-borrows' CARGO_TARGET_DIR=target/miri cargo +nightly miri test -p tracer-core \
             --test soundness"],
    ),
    proof(
        "miri-borrows",
        Asked,
        "who may point where in the lanes' unsafe code, under Miri; half an hour",
        &[Nightly(&["miri", "rust-src"])],
        &["MIRIFLAGS='-Zmiri-disable-isolation -Zmiri-ignore-leaks -Zmiri-permissive-provenance \
             -Zmiri-tree-borrows' CARGO_TARGET_DIR=target/miri cargo +nightly miri test -p tracer-core --lib -- \
             lanes"],
    ),
    proof(
        "mitsuba",
        Asked,
        "eleven scenes against Mitsuba 3; half an hour",
        MITSUBA,
        &[
            "cargo build --release --locked",
            "DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM-19.so python bench/peers/compare.py",
        ],
    ),
];
