# libnook.so: all rooms of host/ but app, behind the front door render/scene_renderer.hpp. Its symbols are versioned by the
# project's version, so that a program never runs with a library that it was not built for; what it is made with (OpenEXR,
# toml++, ...) stays inside. With add_subdirectory and with find_package(nook) alike it is the target nook::nook:
#
#   find_package(nook 0.1 REQUIRED)
#   target_link_libraries(mine PRIVATE nook::nook)
set(rooms ${NOOK_LIBRARIES})
list(REMOVE_ITEM rooms math)  # headers alone
list(TRANSFORM rooms PREPEND nook_)
set(objects ${rooms})
list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
set(version_script ${PROJECT_BINARY_DIR}/libnook.version)
configure_file(${PROJECT_SOURCE_DIR}/cmake/libnook.version.in ${version_script} @ONLY)

add_library(nook_library SHARED ${objects})
add_library(nook::nook ALIAS nook_library)
set_target_properties(nook_library PROPERTIES
  OUTPUT_NAME nook EXPORT_NAME nook LINKER_LANGUAGE CXX LINK_DEPENDS ${version_script}
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_link_libraries(nook_library PRIVATE ${rooms})
target_link_options(nook_library PRIVATE -Wl,--version-script=${version_script})
target_compile_features(nook_library PUBLIC cxx_std_20)
target_include_directories(nook_library INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/host> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/host/base/include> $<INSTALL_INTERFACE:include/nook>)
