# Targets `format` (rewrites) and `format-check` (reports): clang-format over the C++ sources, which
# tests/lint/format.cmake holds to it.
find_program(NOOK_CLANG_FORMAT clang-format)
if(NOOK_CLANG_FORMAT)
  file(GLOB_RECURSE formatted CONFIGURE_DEPENDS
       ${PROJECT_SOURCE_DIR}/host/*.[ch]pp ${PROJECT_SOURCE_DIR}/tests/*.[ch]pp ${PROJECT_SOURCE_DIR}/bench/*.[ch]pp
       ${PROJECT_SOURCE_DIR}/scenes/*.[ch]pp ${PROJECT_SOURCE_DIR}/examples/*.[ch]pp ${PROJECT_SOURCE_DIR}/python/*.[ch]pp)
  add_custom_target(format COMMAND ${NOOK_CLANG_FORMAT} -i ${formatted} VERBATIM)
  add_custom_target(format-check COMMAND ${NOOK_CLANG_FORMAT} --dry-run -Werror ${formatted} VERBATIM)
endif()
