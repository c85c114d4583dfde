// Putting a shader's text together, and tracing a compiler's message back to its file.
#include "headless.h"
#include "scenes.h"

#include "core/render/compose.h"

using namespace mb;

TEST_CASE("includes are resolved once, with the lines of their files") {
    const Texts texts = {{"main.glsl", "#version 330 core\n#include \"a.glsl\"\nm1\n#include \"b.glsl\"\nm2\n"},
                         {"a.glsl", "a1\n#include \"b.glsl\"\na2\n"},
                         {"b.glsl", "b1"}};
    const Composed composed = resolve(texts, "main.glsl", "#define X\n");
    CHECK(composed.text == "#version 330 core\n#define X\n#line 2 0\n#line 1 1\na1\n#line 1 2\nb1\n#line 3 1\na2\n#line 3 0\nm1\n#line 5 0\nm2\n");
    CHECK(composed.files == std::vector<std::string>{"main.glsl", "a.glsl", "b.glsl"});
}

TEST_CASE("a cycle ends, a missing file is an error of the shader, an empty file is nothing") {
    CHECK(resolve({{"a", "#include \"b\"\n"}, {"b", "#include \"a\"\nx\n"}}, "a").text == "#line 1 1\n#line 2 1\nx\n#line 2 0\n");
    CHECK(resolve({{"a", "#include \"gone\"\n"}}, "a").text.starts_with("#error there is no shader file gone\n"));
    CHECK(resolve({{"a", ""}}, "a").text.empty());
    CHECK(resolve({{"a", "// #include \"b\"\n"}}, "a").text == "// #include \"b\"\n");
}

TEST_CASE("a compiler's message names the file") {
    HeadlessRenderer headless;
    Texts texts = shaderLibrary();
    texts["scene.glsl"] = "float map(vec3 p) { return 0.0; }\nNearest nearest(vec3 p) { return oops; }\nvoid readScene() {}\n";
    const Program program = makeProgram(resolve(texts, "fragment.glsl", head(Plan{}, {1, 1, 1, 1}, false)));
    CHECK(!program.usable());
    CHECK_MESSAGE(program.log.find("scene.glsl:2") != std::string::npos, program.log);
    CHECK(program.log.find("oops") != std::string::npos);
}

TEST_CASE("two trees that differ in values have one text") {
    Scene a, b;
    const int cut = addObject(a, "subtract", {0.2});
    addObject(a, "box", {1, 1, 1, 0}, {}, cut);
    addObject(a, "sphere", {1}, {1, 0, 0}, cut);
    b = a;
    b.objects[0].numbers[0] = 0.5, b.objects[1].pos = {3, 2, 1}, b.objects[2].scale = 4, b.objects[2].rot = {1, 2, 3};
    CHECK(sceneGlsl(makeTree(a)) == sceneGlsl(makeTree(b)));
    b.objects[0].numbers[0] = 0;
    CHECK(sceneGlsl(makeTree(a)) != sceneGlsl(makeTree(b)));  // a plain operator costs nothing for the blend it lacks
}
