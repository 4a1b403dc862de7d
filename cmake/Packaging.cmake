# cmake --install build, and `cpack --config build/CPackConfig.cmake -B build` for a .deb (needs the group
# `package` of .ci/packages).
include(GNUInstallDirs)

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nook/scenes
        FILES_MATCHING PATTERN "*.toml" PATTERN "README.md" PATTERN meshgen EXCLUDE PATTERN generated EXCLUDE
        PATTERN thumbnails EXCLUDE)
install(DIRECTORY scenes/thumbnails DESTINATION ${CMAKE_INSTALL_DATADIR}/nook/scenes OPTIONAL)
if(NOOK_SCENES)
  install(DIRECTORY scenes/generated DESTINATION ${CMAKE_INSTALL_DATADIR}/nook/scenes
          FILES_MATCHING PATTERN "*.obj" PATTERN "*.mtl")
endif()

# The library, and what a project that builds on it needs (find_package(nook)).
include(CMakePackageConfigHelpers)
install(TARGETS nook_library EXPORT nookTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/host/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nook
        FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE PATTERN page EXCLUDE)
install(DIRECTORY ${PROJECT_BINARY_DIR}/host/base/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nook)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nook/kernels)
install(FILES ${PROJECT_SOURCE_DIR}/kernels/config.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nook/kernels)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/nook)
install(EXPORT nookTargets NAMESPACE nook:: DESTINATION ${package})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/nookConfig.cmake.in ${PROJECT_BINARY_DIR}/nookConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nookConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nookConfig.cmake ${PROJECT_BINARY_DIR}/nookConfigVersion.cmake DESTINATION ${package})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "nook maintainers <nook@example.org>")
set(CPACK_PACKAGE_DESCRIPTION
"nook estimates ambient occlusion and reflection occlusion by ray tracing in OpenCL, on a CPU or a GPU, and
ambient occlusion in screen space by OpenGL without a display. It shows what accuracy costs in time: the
error of an image can be asked for, measured, and compared.")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so that no link tells: the OpenCL loader, a device for it, and OSMesa for SSAO.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "ocl-icd-libopencl1 | libopencl1, pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENTS_GROUPING IGNORE)
if(TARGET nook_python_package)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL Unspecified python)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME nook)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-nook)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "nook (= ${PROJECT_VERSION}), python3 (>= 3.11), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"nook in Python
The module nook: ambient occlusion, reflection occlusion and bent normals as NumPy arrays, of meshes and points.")
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libosmesa6, glmark2-data, libjs-chart.js")
include(CPack)
