# Writes OUT, a C++ file with the text of each of FILES (below ROOT) for src/core/render/shader_texts.h.
set(rows "")
foreach(file ${FILES})
  file(READ ${ROOT}/${file} text)
  # A string literal of a compiler may be limited to 64 KiB; none of these files comes near.
  string(APPEND rows "    {\"${file}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"core/render/shader_texts.h\"\n\nnamespace mb {\nnamespace {\nconstexpr ShaderText kTexts[] = {\n${rows}};\n}  // namespace\nstd::span<const ShaderText> shaderTexts() { return kTexts; }\n}  // namespace mb\n")
