# nook_add_subdirectories(NAMES...): those that have a CMakeLists.txt.
# nook_library(NAME LINK ... PRIVATE_LINK ...): one static library of the folder's .cpp files, usable as nook::NAME.
# nook_embed(TARGET NAMESPACE ROOT FILES...): text files as a constexpr table {path, text}.

add_library(nook_flags INTERFACE)
target_compile_options(nook_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
# Contracting a*b+c on the host would make its geometry differ between compilers.
target_compile_options(nook_flags INTERFACE -ffp-contract=off)
target_include_directories(nook_flags INTERFACE ${PROJECT_SOURCE_DIR}/host ${PROJECT_SOURCE_DIR})
if(NOOK_SANITIZE)
  target_compile_options(nook_flags INTERFACE -fsanitize=${NOOK_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(nook_flags INTERFACE -fsanitize=${NOOK_SANITIZE})
endif()

macro(nook_add_subdirectories)
  foreach(folder ${ARGN})
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/CMakeLists.txt)
      add_subdirectory(${folder})
    endif()
  endforeach()
endmacro()

function(nook_library name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE_LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(sources)
    add_library(nook_${name} STATIC ${sources})
    target_link_libraries(nook_${name} PUBLIC nook_flags ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  else()
    add_library(nook_${name} INTERFACE)
    target_link_libraries(nook_${name} INTERFACE nook_flags ${ARG_LINK})
  endif()
  add_library(nook::${name} ALIAS nook_${name})
endfunction()

function(nook_embed target namespace root)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  set(files ${ARGN})
  list(TRANSFORM files PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAMESPACE=${namespace} -DROOT=${root} -DDIR=${CMAKE_CURRENT_SOURCE_DIR}
            "-DFILES=${joined}" -P ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake
    DEPENDS ${inputs} ${PROJECT_SOURCE_DIR}/cmake/Embed.cmake
    VERBATIM)
  add_library(${target} STATIC ${out})
  target_link_libraries(${target} PUBLIC nook_flags)
endfunction()
