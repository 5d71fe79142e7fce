# What the build needs from elsewhere. What is missing is gathered, so that one sentence tells all of it.
set(carom_missing "")

# Does what find_package does.
macro(carom_need name)
  find_package(${name} QUIET ${ARGN})
  if(NOT ${name}_FOUND)
    list(APPEND carom_missing ${name})
  endif()
endmacro()

# Looks for a header where the compiler will.
include(CheckIncludeFileCXX)
macro(carom_need_header header)
  string(MAKE_C_IDENTIFIER ${header} carom_header)
  check_include_file_cxx(${header} CAROM_HAS_${carom_header})
  if(NOT CAROM_HAS_${carom_header})
    unset(CAROM_HAS_${carom_header} CACHE)  # so that it is looked for again
    list(APPEND carom_missing ${header})
  endif()
endmacro()

# Ends the build where something is missing. KINDS are those of debian-packages.txt that it is built for.
function(carom_end_where_missing) # KINDS...
  if(NOT carom_missing)
    return()
  endif()
  list(JOIN ARGN "|" kinds)
  file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/debian-packages.txt packages REGEX "^(${kinds}) ")
  list(TRANSFORM packages REPLACE "^[a-z]+ +" "")
  list(JOIN packages " " packages)
  list(JOIN carom_missing ", " missing)
  message(FATAL_ERROR "carom needs what Debian calls: ${packages}; apt-get install these (not found: ${missing})")
endfunction()
