# kinefile_embed(TARGET FILE SYMBOL): puts a file into the read-only data of a target, from SYMBOL_begin to
# SYMBOL_end. The assembler reads it, so it costs the compiler nothing, and it is built in anew when
# the file changes. The directory needs enable_language(ASM).
function(kinefile_embed target file symbol)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${symbol}.S")
  set(EMBED_FILE "${file}")
  set(EMBED_SYMBOL "${symbol}")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/embed.S.in" "${source}" @ONLY)
  set_source_files_properties("${source}" PROPERTIES OBJECT_DEPENDS "${file}")
  target_sources(${target} PRIVATE "${source}")
endfunction()
