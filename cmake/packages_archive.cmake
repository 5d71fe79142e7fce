# Read by cpack for each generator: in an archive the folder of its name is the prefix, and only the program is in it,
# the static one where it is built.
if(CPACK_GENERATOR MATCHES "^(TGZ|TXZ|TZST)$")
  set(CPACK_PACKAGING_INSTALL_PREFIX "")
  set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
  set(CPACK_COMPONENTS_ALL ${CPACK_CAROM_ARCHIVE_COMPONENT})
endif()
