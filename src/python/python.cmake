# The Python package: python/carom, and the extensions carom._core and carom._files that it stands on. All are laid out in the build directory, so that
# PYTHONPATH=build/release/python is all that a test needs; pip installs them as a wheel (pyproject.toml).
set(laid_out ${PROJECT_BINARY_DIR}/python/carom)
# Both extensions need the whole library, so it stands beside them, once, and shows them what is of Carom.
get_target_property(kind carom TYPE)
set(carom_python_binaries carom_python_core carom_python_files)
set(carom_python_library carom)
if(NOT kind STREQUAL "SHARED_LIBRARY")
  set(carom_python_library carom_python_engine)
  list(APPEND carom_python_binaries carom_python_engine)
  add_library(carom_python_engine SHARED $<TARGET_OBJECTS:carom>)
  set(shown ${PROJECT_SOURCE_DIR}/src/python/shown_by_the_engine.map)
  set_target_properties(carom_python_engine PROPERTIES OUTPUT_NAME carom LINKER_LANGUAGE CXX LIBRARY_OUTPUT_DIRECTORY ${laid_out}
                                                       LINK_DEPENDS ${shown})
  target_link_libraries(carom_python_engine PRIVATE fmt::fmt Threads::Threads tomlplusplus::tomlplusplus ${CAROM_QUADMATH_LIBRARY})
  target_link_options(carom_python_engine PRIVATE LINKER:--gc-sections LINKER:--as-needed LINKER:-Bsymbolic LINKER:--version-script=${shown})
endif()
set(core_sources blocking core given_state scene simulation state structure)
list(TRANSFORM core_sources REPLACE "(.+)" "src/python/\\1.cpp")
file(GLOB files_sources CONFIGURE_DEPENDS src/python/*.cpp)
list(TRANSFORM files_sources REPLACE "^${PROJECT_SOURCE_DIR}/" "")
list(REMOVE_ITEM files_sources ${core_sources})
foreach(module core files)
  set(target carom_python_${module})
  nanobind_add_module(${target} STABLE_ABI NB_STATIC NB_SUPPRESS_WARNINGS ${${module}_sources})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME _${module} LIBRARY_OUTPUT_DIRECTORY ${laid_out} CXX_VISIBILITY_PRESET hidden)
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PRIVATE ${carom_python_library} carom carom_build_flags Boost::headers fmt::fmt)  # in this order
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)  # what takes time is in the library
  if(CAROM_UNITY AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 3)  # nanobind's headers take most of the time
  endif()
  target_link_options(${target} PRIVATE LINKER:--gc-sections LINKER:--exclude-libs,ALL LINKER:--as-needed)
  install(FILES ${laid_out}/_${module}.pyi DESTINATION carom COMPONENT python EXCLUDE_FROM_ALL)
endforeach()
target_link_libraries(carom_python_files PRIVATE carom_studies nlohmann_json::nlohmann_json)
set_target_properties(${carom_python_binaries} PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN")
install(TARGETS ${carom_python_binaries} LIBRARY DESTINATION carom COMPONENT python EXCLUDE_FROM_ALL)
# Python files stay where they are; links to them stand beside the extension.
file(GLOB files RELATIVE ${PROJECT_SOURCE_DIR}/python/carom CONFIGURE_DEPENDS python/carom/*.py python/carom/py.typed)
file(MAKE_DIRECTORY ${laid_out})
foreach(file IN LISTS files)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/carom/${file} ${laid_out}/${file} SYMBOLIC)
endforeach()
# Stubs are read from the modules themselves, whose functions name each other's classes.
foreach(module core files)
  nanobind_add_stub(carom_python_stub_${module} MODULE carom._${module} OUTPUT ${laid_out}/_${module}.pyi PYTHON_PATH ${PROJECT_BINARY_DIR}/python
                    DEPENDS carom_python_core carom_python_files)
endforeach()
add_custom_target(carom_python DEPENDS carom_python_stub_core carom_python_stub_files)
