# Installs what `cargo cinstall` installs, in the same places.
install(FILES include/qsmesh.h include/qsmesh.hpp DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(FILES "${QSMESH_LIBRARY_FOLDER}/${QSMESH_STATIC_NAME}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(PROGRAMS "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SHARED_NAME}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(FILES "${QSMESH_LIBRARY_FOLDER}/${QSMESH_SONAME}" "${QSMESH_LIBRARY_FOLDER}/${QSMESH_CARGO_NAME}"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}")

# Found from where the file itself is, so that the installed folder can be moved.
file(RELATIVE_PATH QSMESH_PREFIX_FROM_PC "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(QSMESH_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
else()
    string(REGEX REPLACE "/$" "" QSMESH_PREFIX_FROM_PC "${QSMESH_PREFIX_FROM_PC}")
    set(QSMESH_PC_PREFIX "\${pcfiledir}/${QSMESH_PREFIX_FROM_PC}")
endif()
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY "\${prefix}" OUTPUT_VARIABLE QSMESH_PC_LIBDIR)
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY "\${prefix}" OUTPUT_VARIABLE QSMESH_PC_INCLUDEDIR)
configure_file(cmake/qsmesh.pc.in qsmesh.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/qsmesh.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

install(FILES cmake/package/qsmesh-config.cmake cmake/package/qsmesh-config-version.cmake
        DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/qsmesh")
