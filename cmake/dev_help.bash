# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# The texts that ./dev --help and ./dev COMMAND --help print; dev reads this file then.

help_all() {
  cat <<'HELP'
./dev: build, run and check Orca. Start with:   ./dev run graphs/scout_goto.xml

  ./dev setup            install the Debian packages that Orca needs (silent if all are installed)
  ./dev build [PRESET]   compile; PRESET is release (default), dev, asan, tsan, coverage, fuzz or bench
  ./dev run GRAPH ...    start a robot system: build/release/bin/deployer GRAPH ...
  ./dev quick            before a commit: build, and run what needs no real time
  ./dev test [LABEL]     build and run the tests: the normal suite, or the tests with one label
  ./dev nightly          everything else too: slow tests, sanitizers, fuzzers, mutants, benchmarks (hours)
  ./dev bench            build and run the benchmarks
  ./dev package          make Debian packages: build/release/packages/orca-*.deb
  ./dev lint             check the sources: layers, headers, licences, format, function size, documents
  ./dev docs             build the book: all pages with search, and the reference of C++, components and programs

Every command does its preparations by itself: run and test first install packages and build.
./dev COMMAND --help describes one command. Messages go to stderr, results to stdout.
HELP
}

help_setup() {
  cat <<HELP
./dev setup

Installs the Debian packages that are missing, as root or through sudo. It changes nothing if all are installed.

  always:             ${PACKAGES[*]}
  for preset fuzz:    ${FUZZ_PACKAGES[*]}
  for coverage:       ${COVERAGE_PACKAGES[*]}
  for packages:       ${PACKAGING_PACKAGES[*]}
  for the book:       ${DOCS_PACKAGES[*]}
HELP
}

help_build() {
  cat <<'HELP'
./dev build [PRESET]

Configures one preset and compiles everything into build/PRESET (with bench only the benchmarks, with fuzz only the
fuzzers). Programs go to build/PRESET/bin, plugins to build/PRESET/plugins. The presets:

HELP
  sed -n 's/^ *{"name": "\([a-z]*\)", "inherits": "[a-z]*",.*"description": "\([^"]*\)".*/  \1\t\2/p' \
    "$ROOT/CMakePresets.json" | expand -t 12
}

help_run() {
  cat <<'HELP'
./dev run GRAPH [OPTION]...

Builds everything that a run needs (preset release; nothing if it is up to date) and replaces itself by

  build/release/bin/deployer GRAPH [OPTION]...

Stdin, stdout, signals and the exit status are therefore those of the deployer, and so are the options, for example
--check, --clock virtual, --seed 7, --until 60s. build/release/bin/deployer --help lists them.
HELP
}

help_test() {
  cat <<'HELP'
./dev test [LABEL]

Builds preset release, compiles each public header alone, and runs the tests. The last lines are ctest's summary. The
exit status is 0 if every test passed.

  (no label)   the normal suite: all tests except those labelled san, bench, fuzz-long, slow or slurm
  san          the suite again, built with the address+undefined sanitizers, then with the thread sanitizer
  coverage     the suite again, built with --coverage; prints a table for src without plugins and programs
  fuzz         each fuzz target for 60 s, built with clang
  lint         source checks only, like ./dev lint
  LABEL        tests with that label: unit, contract, graph, system, dds, docs, slow, slurm ...
HELP
}

help_quick() {
  cat <<'HELP'
./dev quick

Builds preset release and runs the tests that need no real time: units, contracts, source checks, documents, and the system in
virtual time. The exit status is 0 if every test passed. ./dev test runs them too, and all that start processes and wait.
HELP
}

help_nightly() {
  cat <<'HELP'
./dev nightly [PART]...

Runs what the normal suite leaves out, part by part; a part that fails does not keep the next from running. The exit status is
0 if all passed. The parts, in their order (default: all):

  slow       tests labelled slow
  san        the suite with the address+undefined sanitizers, then with the thread sanitizer
  fuzz       each fuzz target for 60 s
  mutants    60 small mistakes in the sources, of which the tests must notice 95 percent; another 60 each day
  bench      the benchmarks; their times go to build/nightly/bench-DATE.json
HELP
}

help_bench() {
  cat <<'HELP'
./dev bench [OPTION]...

Builds the benchmarks (preset bench), runs them on one core and prints one table. Each row compares an operation of Orca
with the barest reference that does the same, measured alternately in one run. Options go to build/bench/bench/orca_bench:

  --gate                      exit status 1 if a target is missed (otherwise it is only reported)
  --benchmark_filter=REGEX    run only matching benchmarks, for example push
  --benchmark_out=FILE        also write the times as Google Benchmark's JSON
HELP
}

help_package() {
  cat <<'HELP'
./dev package

Builds preset release and makes Debian packages of it, whose names it prints. To install those that you want, with what they
need:  sudo apt install ./build/release/packages/orca-{runtime,tools,simulator}_*.deb     docs/install.md says what is in each.
HELP
}

help_lint() {
  printf './dev lint\n\nRuns the tests labelled lint (tests/lint). Each check first proves on bad examples that it can fail.\n'
}

help_docs() {
  cat <<'HELP'
./dev docs

Builds preset release and a book of all pages: README.md, docs/ and those of components, with the ports and parameters of every
component, the fields of every object, the options of every program, and the public C++. It needs no network to be read. The last line is
its first page; for the search read it through  python3 -m http.server -d build/docs
Any warning, and a link that leads nowhere, makes it fail. ./dev test docs checks the pages without building the book.
HELP
}
