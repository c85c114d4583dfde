# Makes the primitive of docs/extending.md: below OUT, copies of the files it needs, with its code where the document puts it.
file(READ ${ROOT}/docs/extending.md document)

# The document's next block of code in that language.
function(take language variable)
  string(FIND "${document}" "```${language}\n" from)
  if(from EQUAL -1)
    message(FATAL_ERROR "docs/extending.md lacks a block of ${language}")
  endif()
  string(SUBSTRING "${document}" ${from} -1 rest)
  string(REGEX REPLACE "^```[a-z]+\n" "" rest "${rest}")
  string(FIND "${rest}" "```" to)
  string(SUBSTRING "${rest}" 0 ${to} code)
  string(SUBSTRING "${rest}" ${to} -1 rest)
  set(document "${rest}" PARENT_SCOPE)
  set(${variable} "${code}" PARENT_SCOPE)
endfunction()
# Writes code behind a line of a file's copy.
function(put file line code)
  file(READ ${OUT}/${file} text)
  string(REPLACE "${line}\n" "${line}\n${code}" more "${text}")
  if(more STREQUAL text)
    message(FATAL_ERROR "${file} lacks the line ${line}")
  endif()
  file(WRITE ${OUT}/${file} "${more}")
endfunction()

foreach(file src/core/sdf/call.h src/core/sdf/glsl.h src/core/sdf/scalar.h src/core/sdf/shape.h src/core/sdf/primitives.cpp
             shaders/sdf/domains.glsl shaders/sdf/operators.glsl shaders/sdf/primitives.glsl)
  configure_file(${ROOT}/${file} ${OUT}/${file} COPYONLY)
endforeach()

take(glsl distance)
take(cpp row)
take(glsl span)
take(cpp spanned)
put(shaders/sdf/primitives.glsl "vec2 innerSphere(vec3 o, vec3 d, real radius) { return spanBall(o, d, radius * narrower()); }" "${distance}${span}")

# The parameters, an ellipsis, the row; and the row's place in its span's.
string(REGEX MATCH "^(.*)…(.*),[ \n]*$" found "${row}")
string(REPLACE "row(…)" "${CMAKE_MATCH_2}" spanned "${spanned}")
put(src/core/sdf/primitives.cpp "constexpr Box around(double x, double y, double z) { return {{-x, -y, -z}, {x, y, z}}; }" "${CMAKE_MATCH_1}")
put(src/core/sdf/primitives.cpp "constexpr Primitive kPrimitives[] = {" "${spanned}")
