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
    CHECK(composed.text == "#version 330 core\n#define X\n#line 2\n#line 100001\na1\n#line 200001\nb1\n#line 100003\na2\n#line 3\nm1\n#line 5\nm2\n");
    CHECK(composed.files == std::vector<std::string>{"main.glsl", "a.glsl", "b.glsl"});
}

TEST_CASE("a cycle ends, a missing file is an error of the shader, an empty file is nothing") {
    CHECK(resolve({{"a", "#include \"b\"\n"}, {"b", "#include \"a\"\nx\n"}}, "a").text == "#line 100001\n#line 100002\nx\n#line 2\n");
    CHECK(resolve({{"a", "#include \"gone\"\n"}}, "a").text.starts_with("#error there is no shader file gone\n"));
    CHECK(resolve({{"a", ""}}, "a").text.empty());
    CHECK(resolve({{"a", "// #include \"b\"\n"}}, "a").text == "// #include \"b\"\n");
}

TEST_CASE("a place is named by its file and line, in whatever form a compiler writes it") {
    const Composed composed{"", {"main.glsl", "a.glsl"}};
    CHECK(readablePlace(composed, 14) == "main.glsl:14");
    CHECK(readablePlace(composed, 100'014) == "a.glsl:14");
    CHECK(readablePlace(composed, 200'014) == "line 200014");
    CHECK(readableLog(composed, "0:100014(7): error: x\nERROR: 0:14: y\n0(100014) : error z\nplain") ==
          "a.glsl:14: error: x\nERROR: main.glsl:14: y\na.glsl:14 : error z\nplain\n");
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
