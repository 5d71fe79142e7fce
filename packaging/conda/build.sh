#!/usr/bin/env bash
# Not run yet. conda calls it in the folder of the sources.
set -euo pipefail

# shellcheck disable=SC2086  # CMAKE_ARGS are several words
cmake -S . -B build/conda -G Ninja ${CMAKE_ARGS:-} -D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX="$PREFIX" -D CMAKE_INSTALL_LIBDIR=lib \
  -D CAROM_BUILD_TESTS=OFF -D CAROM_BUILD_BENCH=OFF -D CAROM_MPI=OFF -D CAROM_PYTHON=ON -D Python_EXECUTABLE="$PYTHON"
cmake --build build/conda --parallel "${CPU_COUNT:-1}"
cmake --install build/conda
cmake --install build/conda --component python --prefix "$SP_DIR"
cp python/carom/*.py python/carom/py.typed "$SP_DIR/carom/"
