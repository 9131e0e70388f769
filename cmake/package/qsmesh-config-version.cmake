# Whether the installed version does for the one asked for: the same interface, and not older. Versions that begin with
# 0 have the same interface only as long as the second number is the same.
file(GLOB qsmesh_pc "${CMAKE_CURRENT_LIST_DIR}/../../../lib*/pkgconfig/qsmesh.pc"
     "${CMAKE_CURRENT_LIST_DIR}/../../../lib/*/pkgconfig/qsmesh.pc")
if(NOT qsmesh_pc)
    set(PACKAGE_VERSION_UNSUITABLE TRUE)
    return()
endif()
list(GET qsmesh_pc 0 qsmesh_pc)
file(STRINGS "${qsmesh_pc}" PACKAGE_VERSION REGEX "^Version:")
string(REGEX REPLACE "^Version: *" "" PACKAGE_VERSION "${PACKAGE_VERSION}")

set(qsmesh_interface "^[0-9]+")
if(PACKAGE_VERSION VERSION_LESS 1)
    set(qsmesh_interface "^0\\.[0-9]+")
endif()
string(REGEX MATCH "${qsmesh_interface}" qsmesh_has "${PACKAGE_VERSION}")
string(REGEX MATCH "${qsmesh_interface}" qsmesh_wants "${PACKAGE_FIND_VERSION}")
if(PACKAGE_FIND_VERSION STREQUAL "" OR (qsmesh_has STREQUAL qsmesh_wants AND PACKAGE_VERSION VERSION_GREATER_EQUAL PACKAGE_FIND_VERSION))
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_VERSION VERSION_EQUAL PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
endif()
