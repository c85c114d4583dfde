#include "core/scene/text.h"
#include "core/scene/text_value.h"

namespace mb {
namespace {

using text::nameText, text::sameBits, text::valueText;

/// Appends ` key:value` for every row that `wanted` and that does not have the default's value.
template <class Record, class Wanted> void appendKeys(std::string& out, const Record& record, Wanted wanted) {
    static const Record initial{};
    for (const Key<Record>& key : keys<Record>()) {
        if (!wanted(key)) continue;
        std::visit([&](auto member) {
            const auto& value = valueAt(record, member);
            if (!key.required && sameBits(value, valueAt(initial, member))) return;
            out.append(" ").append(key.name).append(":").append(valueText(value));
        }, key.member);
    }
}

template <class Record> void appendRecord(std::string& out, std::string_view keyword, const Record& record) {
    out += keyword;
    appendKeys(out, record, [](const Key<Record>&) { return true; });
    out += '\n';
}

/// A record that need not stand in a file does not if it says nothing.
template <class Record> void appendUnlessInitial(std::string& out, std::string_view keyword, const Record& record) {
    const std::size_t before = out.size();
    appendRecord(out, keyword, record);
    if (out.size() == before + keyword.size() + 1) out.resize(before);
}

void appendParameters(std::string& out, const Object& o) {
    const Numbers initial = initialNumbers(*o.type);
    unsigned at = 0;
    for (const Parameter& p : o.type->parameters) {
        const unsigned end = at + static_cast<unsigned>(p.size);
        bool said = !p.optional;
        for (unsigned i = at; i < end; ++i) said |= !sameBits(o.numbers[i], initial[i]);
        if (said) out.append(" ").append(p.name).append(":");
        for (; at < end; ++at) {
            if (!said) continue;
            if (p.kind == Parameter::Kind::word) out += p.words[static_cast<std::size_t>(o.numbers[at])];
            else out += text::number(o.numbers[at]);
            if (at + 1 < end) out += ',';
        }
    }
}

void appendObject(std::string& out, const Scene& scene, const Object& o, std::size_t level) {
    out.append(2 * level, ' ').append("object");
    appendKeys(out, o, [](const Key<Object>& key) { return key.name == "name"; });
    out.append(" type:").append(o.type->name);
    if (o.material != kNoMaterial)
        out.append(" material:").append(nameText(scene.materials[static_cast<std::size_t>(o.material)].name));
    appendKeys(out, o, [](const Key<Object>& key) { return key.name != "name" && !key.body; });
    appendParameters(out, o);
    appendKeys(out, o, [](const Key<Object>& key) { return key.body; });
    out += '\n';
}

}  // namespace

std::string writeScene(const Scene& scene) {
    std::string out = "marchbox 1\n" + scene.comment;
    appendUnlessInitial(out, "world", scene.world);
    for (const Camera& camera : scene.cameras) appendRecord(out, "camera", camera);
    for (const Light& light : scene.lights) appendRecord(out, "light", light);
    for (const Material& material : scene.materials) appendRecord(out, "material", material);
    appendUnlessInitial(out, "render", scene.render);
    appendUnlessInitial(out, "physics", scene.physics);
    std::vector<std::size_t> levels(scene.objects.size(), 0);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        if (o.parent != kNoParent) levels[i] = levels[static_cast<std::size_t>(o.parent)] + 1;
        appendObject(out, scene, o, levels[i]);
    }
    return out;
}

}  // namespace mb
