# Writes HEADER with the git commit of SOURCE_DIR, and leaves it alone when nothing has changed. Runs at every build.
# "unknown" where SOURCE_DIR is not itself a checkout: a tarball that lies inside another project's checkout must not
# show that project's commit.
cmake_minimum_required(VERSION 3.25)

set(commit "unknown")
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE_DIR}/.git")
  execute_process(COMMAND "${GIT}" -c "safe.directory=${SOURCE_DIR}" -C "${SOURCE_DIR}"
                          describe --always --abbrev=12 --dirty "--exclude=*"
                  OUTPUT_VARIABLE described RESULT_VARIABLE result ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(result EQUAL 0)
    set(commit "${described}")
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT "#define CAROM_COMMIT \"@commit@\"\n")
