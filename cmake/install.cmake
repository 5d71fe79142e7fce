# What `cmake --install` puts below the prefix. The components are the packages of packages.cmake: program, mpi, library, and python3
# and static, which only a package installs.
set(carom_package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
# A static library does not carry what it links to, so its user's linker needs that too; for nothing else are HDF5 and Cairo looked
# for, and only where their components are asked for.
get_target_property(carom_type carom TYPE)
set(carom_static FALSE)
if(carom_type STREQUAL "STATIC_LIBRARY")
  set(carom_static TRUE)
endif()
foreach(component carom ${CAROM_COMPONENTS})
  string(REGEX REPLACE "^(io|pages)$" "carom_\\1" target ${component})
  install(TARGETS ${target} EXPORT ${target} ARCHIVE COMPONENT library LIBRARY COMPONENT program NAMELINK_COMPONENT library
          FILE_SET HEADERS COMPONENT library)
  install(EXPORT ${target} NAMESPACE carom:: FILE ${target}Targets.cmake DESTINATION ${carom_package_directory} COMPONENT library)
endforeach()
configure_package_config_file(caromConfig.cmake.in caromConfig.cmake INSTALL_DESTINATION ${carom_package_directory} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(caromConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/caromConfig.cmake ${PROJECT_BINARY_DIR}/caromConfigVersion.cmake
        DESTINATION ${carom_package_directory} COMPONENT library)

# The same for pkg-config: carom, carom-io, carom-pages. The files find the prefix from where they are.
file(RELATIVE_PATH carom_prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
list(TRANSFORM carom_eigen_definitions PREPEND -D OUTPUT_VARIABLE carom_eigen_flags)
list(JOIN carom_eigen_flags " " carom_eigen_flags)
# What a program links to beside Carom's library: with a static one all that it uses, with a shared one nothing.
function(carom_pc name library description requires private)
  set(needs "${requires}")
  set(links "-l${library}")
  if(carom_static)
    string(APPEND needs " ${private}")
    if(library STREQUAL "carom" AND CAROM_QUADMATH_LIBRARY)
      string(APPEND links " -l${CAROM_QUADMATH_LIBRARY}")
    endif()
    string(APPEND links " -pthread")
  endif()
  file(CONFIGURE OUTPUT ${name}.pc @ONLY CONTENT "prefix=\${pcfiledir}/@carom_prefix_from_pc@
includedir=\${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
libdir=\${prefix}/@CMAKE_INSTALL_LIBDIR@

Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Requires: @needs@
Cflags: -I\${includedir} -std=c++20 @carom_eigen_flags@
Libs: -L\${libdir} @links@
")
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
endfunction()
# Debian has HDF5 for one machine and for MPI beside each other.
set(carom_hdf5_pc hdf5)
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  foreach(name hdf5 hdf5-serial)
    pkg_check_modules(carom_pc_${name} QUIET ${name})
    if(carom_pc_${name}_FOUND)
      set(carom_hdf5_pc ${name})
      break()
    endif()
  endforeach()
endif()
carom_pc(carom carom "Event-driven molecular dynamics of hard disks" "eigen3" "fmt tomlplusplus")
if(TARGET carom_io)
  carom_pc(carom-io carom_io "Reads the files of Carom's runs" "carom" "${carom_hdf5_pc}")
endif()
if(TARGET carom_pages)
  set(carom_cairo_pc "")
  if(CAROM_FILMS)
    set(carom_cairo_pc cairo)
  endif()
  carom_pc(carom-pages carom_pages "HTML pages of Carom's results" "carom-io" "${carom_cairo_pc}")
endif()

# What comes with the program, and once more with the static one, which is in no installation but that of its component.
set(carom_generated ${PROJECT_BINARY_DIR}/generated)
function(carom_install_beside_program) # COMPONENT name [EXCLUDE_FROM_ALL]
  install(FILES ${PROJECT_SOURCE_DIR}/build/playground/playground.html DESTINATION ${CMAKE_INSTALL_DATADIR}/carom ${ARGN} OPTIONAL)
  install(DIRECTORY docs/scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/carom/scenes ${ARGN})
  if(CAROM_BUILD_PROGRAM AND NOT CMAKE_CROSSCOMPILING)
    install(DIRECTORY ${carom_generated}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 ${ARGN})
    install(FILES ${carom_generated}/carom.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions ${ARGN} RENAME carom)
    install(FILES ${carom_generated}/carom.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions ${ARGN} RENAME _carom)
    install(FILES ${carom_generated}/carom.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d ${ARGN})
  endif()
endfunction()
carom_install_beside_program(COMPONENT program)
if(CAROM_BUILD_PROGRAM)
  install(TARGETS carom_cli RUNTIME COMPONENT program)
  if(TARGET carom_mpi)
    install(TARGETS carom_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/carom COMPONENT mpi)
  endif()
  # The program knows its own command line.
  if(NOT CMAKE_CROSSCOMPILING)
    add_custom_command(TARGET carom_cli POST_BUILD VERBATIM
                       COMMAND carom_cli man --out ${carom_generated}/man
                       COMMAND carom_cli completion bash > ${carom_generated}/carom.bash
                       COMMAND carom_cli completion zsh > ${carom_generated}/carom.zsh
                       COMMAND carom_cli completion fish > ${carom_generated}/carom.fish)
  endif()
endif()
if(TARGET carom_static)
  install(TARGETS carom_static RUNTIME COMPONENT static EXCLUDE_FROM_ALL)
  install(DIRECTORY ${carom_licences}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/carom/licences COMPONENT static EXCLUDE_FROM_ALL)
  carom_install_beside_program(COMPONENT static EXCLUDE_FROM_ALL)
endif()

if(carom_python_found)
  set(carom_python_place lib/python3/dist-packages/carom)
  install(TARGETS ${carom_python_binaries} LIBRARY DESTINATION ${carom_python_place} COMPONENT python3 EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_BINARY_DIR}/python/carom/_core.pyi ${PROJECT_BINARY_DIR}/python/carom/_files.pyi
          DESTINATION ${carom_python_place} COMPONENT python3 EXCLUDE_FROM_ALL)
  file(GLOB carom_python_files CONFIGURE_DEPENDS python/carom/*.py python/carom/py.typed)
  install(FILES ${carom_python_files} DESTINATION ${carom_python_place} COMPONENT python3 EXCLUDE_FROM_ALL)
endif()
