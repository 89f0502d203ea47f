# Makes a Debian package of the installed files: cpack -G DEB in the build folder, or the target `package`.
install(DIRECTORY scenes/ DESTINATION share/sunfleck/scenes)
install(DIRECTORY share/plots/ DESTINATION share/sunfleck/plots)
install(FILES README.md CHANGELOG.md DESTINATION share/doc/sunfleck)
install(DIRECTORY docs/ DESTINATION share/doc/sunfleck/docs)
install(FILES LICENSE DESTINATION share/doc/sunfleck RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sunfleck)
set(CPACK_PACKAGE_VENDOR sunfleck)
set(CPACK_PACKAGE_CONTACT "the sunfleck engineers <sunfleck@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "sunlight in three-dimensional plant canopies")
set(CPACK_PACKAGE_DESCRIPTION
"How much light does each face of each leaf of a plant stand receive? Rays of
the sun and the sky are followed through a canopy of triangles, on GPUs, software
Vulkan or the processor, with an error bound on every figure.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# dpkg-shlibdeps finds the linked libraries; the following are opened at run time.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, libvulkan1, ${NETCDF_PACKAGE}")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "mesa-vulkan-drivers, gnuplot-nox")
if(TARGET sunfleck_python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(of_python "${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}")
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS
    ", python3 (>= ${of_python}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy, python3-tomli-w")
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, python3-xarray")
endif()
include(CPack)
