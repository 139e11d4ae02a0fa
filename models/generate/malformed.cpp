// SPDX-License-Identifier: LGPL-2.1-or-later
#include "malformed.h"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>

#include "exchange.h"

namespace umbilic::models {
namespace {

std::string content(const std::filesystem::path& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file) throw std::runtime_error(path.string() + ": cannot read");
    return {std::istreambuf_iterator<char>{file}, {}};
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file{path, std::ios::binary};
    file << text;
    if (!file.flush()) throw std::runtime_error(path.string() + ": cannot write");
}

// Replaces the first `old_text` behind the first `anchor`.
std::string replaced(std::string text, const std::string& anchor, const std::string& old_text,
                     const std::string& new_text) {
    const std::size_t at = text.find(old_text, text.find(anchor));
    if (at == std::string::npos) throw std::runtime_error("nothing to spoil: " + old_text);
    return text.replace(at, old_text.size(), new_text);
}

}  // namespace

nlohmann::ordered_json write_malformed(const std::filesystem::path& models) {
    const std::filesystem::path folder = models / "malformed";
    std::filesystem::create_directories(folder);
    auto list = nlohmann::ordered_json::array();
    const auto state = [&](const std::string& name, const std::string& what, const std::string& expected) {
        list.push_back({{"file", "malformed/" + name}, {"what", what}, {"expected", expected}});
    };
    const auto add = [&](const std::string& name, const std::string& text, const std::string& what,
                         const std::string& expected = "error") {
        write(folder / name, text);
        state(name, what, expected);
    };

    const std::string hood = content(models / "hood.step"), blade = content(models / "blade_moved.igs");
    add("truncated.step", hood.substr(0, hood.size() * 6 / 10), "STEP, cut off inside the data section");
    add("truncated.igs", blade.substr(0, blade.size() / 2),
        "IGES, cut off inside the parameter section; OpenCASCADE quietly delivers one of its two faces",
        "error or warning");
    add("prose.step", "This is a letter, not a model.\nIt only bears the ending of one.\n", "plain text named .step");
    add("empty.step", "", "an empty file");
    add("decreasing_knots.step", replaced(hood, "B_SPLINE_SURFACE", "0.2,0.4,0.6,0.8", "0.2,0.6,0.4,0.8"),
        "the only surface has knots that decrease; OpenCASCADE quietly drops one and delivers another surface",
        "error or warning");
    add("zero_weight.step",
        replaced(content(models / "ellipsoid.step"), "RATIONAL_B_SPLINE_SURFACE", "0.353553390593", "0."),
        "the only surface has a weight of zero");

    const gp_Circ circle{gp_Ax2{gp_Pnt{10, 20, 30}, gp_Dir{0, 0, 1}}, 15};
    write_cad(BRepBuilderAPI_MakeWire{BRepBuilderAPI_MakeEdge{circle}}.Wire(), "wire", folder / "no_face.step");
    state("no_face.step", "a valid STEP file that holds a wire and no face", "error");
    return list;
}

}  // namespace umbilic::models
