# Writes OUT, a C++ file with the text of each of FILES (below ROOT) as what the function NAME of HEADER returns.
set(rows "")
foreach(file ${FILES})
  file(READ ${ROOT}/${file} text)
  # A string literal of a compiler may be limited to 64 KiB; none of these files comes near.
  string(APPEND rows "    {\"${file}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
file(WRITE ${OUT} "#include \"${HEADER}\"\n\nnamespace mb {\nnamespace {\nconstexpr ShaderText kTexts[] = {\n${rows}};\n}  // namespace\nstd::span<const ShaderText> ${NAME}() { return kTexts; }\n}  // namespace mb\n")
