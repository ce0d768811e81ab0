# What `cmake --install` and `cpack -G DEB` take: component program (what users run and read), development (static libraries,
# headers, find_package(cnem)) and, where it is built, python.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS cnem RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
configure_file(packaging/cnem.1.in ${PROJECT_BINARY_DIR}/cnem.1 @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cnem.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES packaging/cnem.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME cnem
        COMPONENT program)
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/cnem COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program)
install(FILES README.md METHOD.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)

# cnem::cnem is all of the libraries.
add_library(cnem_all INTERFACE)
set_target_properties(cnem_all PROPERTIES EXPORT_NAME cnem)
target_link_libraries(cnem_all INTERFACE cnem_app)
install(TARGETS ${CNEM_LIBRARIES} cnem_all EXPORT cnem ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(folder ${CNEM_FOLDERS})
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cnem COMPONENT development
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
set(configuration ${CMAKE_INSTALL_LIBDIR}/cmake/cnem)
install(EXPORT cnem NAMESPACE cnem:: FILE cnemTargets.cmake DESTINATION ${configuration} COMPONENT development)
configure_package_config_file(packaging/cnemConfig.cmake.in ${PROJECT_BINARY_DIR}/cnemConfig.cmake
                              INSTALL_DESTINATION ${configuration})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cnemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cnemConfig.cmake ${PROJECT_BINARY_DIR}/cnemConfigVersion.cmake
        DESTINATION ${configuration} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The cnem developers <cnem@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
if(TARGET cnem_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy")
endif()
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_NAME cnem)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core) # the letters of pictures
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)           # films as MP4
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/prerm)
set(CPACK_DEBIAN_DESCRIPTION "Simulates blanking, shearing and orthogonal cutting of metal in large strains,\nwith heat, damage and contact, from one case file to a report.")
include(CPack)
