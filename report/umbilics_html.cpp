// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/umbilics_html.h>

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

#include <report/color_scale.h>
#include <report/json_geometry.h>
#include <report/mark.h>
#include <report/omega_plane.h>
#include <report/page.h>
#include <report/page_data.h>
#include <report/parameter_picture.h>
#include <report/pattern.h>
#include <report/readable.h>
#include <report/scene_mesh.h>
#include <report/umbilics_text.h>
#include <report/views.h>

namespace umbilic {

namespace {

/// Faces that get a picture of their own, rows of their tables and patterns of traced lines; all else is in
/// umbilics.json.
constexpr std::size_t most_faces = 200, most_rows = 100, most_patterns = 200;
/// Sections that are open when the page is.
constexpr std::size_t open_faces = 3;
/// Umbilics of a face that are numbered in its picture, and of the model that are in the omega plane.
constexpr std::size_t most_labels = 40;

constexpr std::array all_types = {UmbilicType::star, UmbilicType::monstar, UmbilicType::lemon,
                                  UmbilicType::non_generic};

/// An umbilic with its place in the lists and its number on the page.
struct Entry {
    const Face* face = nullptr;
    const FaceUmbilics* found = nullptr;
    const Umbilic* umbilic = nullptr;
    int number = 0;
    UmbilicPattern pattern;
};

/// The umbilics that get a row, numbered from 1 over all faces.
std::vector<Entry> numbered(const UmbilicsReportInput& input) {
    std::vector<Entry> entries;
    int number = 0;
    for (const FaceUmbilics& found : input.umbilics)
        for (const Umbilic& umbilic : found.umbilics)
            entries.push_back({&input.model.face(found.face), &found, &umbilic, ++number, {}});
    return entries;
}

std::string error_words(double error) {
    return std::isfinite(error) ? "± " + readable(error, 2) : "no bound";
}

PageData row(const Entry& entry, bool with_pattern, double size) {
    const Umbilic& umbilic = *entry.umbilic;
    const Face& face = *entry.face;
    const UmbilicClass& kind = umbilic.kind;
    const Vector2 native = native_parameters(face, umbilic.at.u, umbilic.at.v);
    const auto coordinate = [&](double value) { return readable_coordinate(value, size); };
    PageData data;
    data.set("number", std::to_string(entry.number));
    data.set("mark", mark_svg(kind.type, 0.0, 0.0, 1.0));
    data.set("pattern", with_pattern ? pattern_svg(umbilic, entry.pattern) : "");
    std::vector<std::string> type = {class_words(kind)};
    if (umbilic.pole != PoleKind::none) type.emplace_back("at a pole");
    if (umbilic.flat) type.emplace_back("flat");
    if (umbilic.on_knot_line) type.emplace_back("on a knot line");
    if (umbilic.containment == Containment::outside) type.emplace_back("outside of the face");
    if (umbilic.containment == Containment::boundary) type.emplace_back("on the face's border");
    data.set("type", lines(type));
    data.set("place", lines({"u " + readable(native.x(), 10), "v " + readable(native.y(), 10)}));
    data.set("point",
             lines({coordinate(umbilic.point.x()), coordinate(umbilic.point.y()), coordinate(umbilic.point.z())}));
    data.set("kappa", lines({umbilic.flat ? "0" : readable(umbilic.kappa, 6), error_words(umbilic.kappa_error)}));
    data.set("omega",
             lines({omega_words(kind), kind.uncertainty.omega ? "± " + readable(*kind.uncertainty.omega, 2) : ""}));
    data.set("delta", lines({readable(kind.delta, 5), "± " + readable(kind.uncertainty.delta, 2)}));
    data.set("index",
             lines({readable(umbilic.index, 2), kind.ridges ? counted(*kind.ridges, "ridge") : "1 or 3 ridges"}));
    const bool below = umbilic.margin > 0.0 && umbilic.margin < face.tolerance;
    data.set("margin", umbilic.margin == 0.0 ? "–" : readable(umbilic.margin, 2) + (below ? " †" : ""));
    data.set("existence", lines({umbilic.certified ? "proved" : "not proved", "± " + readable(umbilic.radius, 2)}));
    return data;
}

std::string face_title(const Face& face, const FaceUmbilics& found) {
    std::vector<std::string> parts;
    if (!found.umbilics.empty()) parts.push_back(counted(found.umbilics.size(), "isolated umbilic"));
    if (!found.lines.empty()) parts.push_back(counted(found.lines.size(), "line"));
    if (!found.regions.empty()) parts.push_back(counted(found.regions.size(), "region"));
    if (!found.undecided.empty()) parts.push_back(counted(found.undecided.size(), "undecided place"));
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return "Face " + std::to_string(face.number) + (face.name.empty() ? "" : " “" + face.name + "”") + ": " + text;
}

std::vector<std::string> face_notes(const FaceUmbilics& found) {
    std::vector<std::string> notes;
    if (found.recognised) notes.push_back(std::string("Recognised: ") + name(found.recognised->kind));
    for (const UmbilicRegion& region : found.regions)
        notes.push_back(std::string("Region on which every point is an umbilic: ") + name(region.kind) + ", " +
                        readable(region.area, "mm²") +
                        (region.kind == UmbilicRegionKind::other
                             ? ""
                             : ", at most " + readable(region.deviation, "mm", 2) + " from its " +
                                   (region.kind == UmbilicRegionKind::planar ? "plane" : "sphere")));
    std::string lengths;
    for (const UmbilicLine& line : found.lines)
        lengths += (lengths.empty() ? "" : ", ") + readable(line.length, 3) + (line.closed ? " (closed)" : "");
    if (!lengths.empty())
        notes.push_back(
            (found.lines.size() == 1 ? "Line of umbilics, length in mm: " : "Lines of umbilics, lengths in mm: ") +
            lengths);
    if (!found.undecided.empty()) {
        std::string indices;
        for (const UndecidedCluster& open : found.undecided)
            indices +=
                (indices.empty() ? "" : ", ") + (open.index ? readable(*open.index, 2) : std::string("not known"));
        notes.push_back("Undecided places (dashed rings), with the sums of the indices of what lies in them: " +
                        indices);
    }
    return notes;
}

std::string surface_words(SurfaceKind kind) {
    switch (kind) {
        case SurfaceKind::bspline:
            return "B-spline surface";
        case SurfaceKind::bezier:
            return "Bézier surface";
        case SurfaceKind::other:
            return "Surface";
        default: {
            std::string word = name(kind);
            word.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(word.front())));
            return word + ", as a surface";
        }
    }
}

PageData face_section(const Face& face, const FaceUmbilics& found, const std::vector<Entry>& entries, std::size_t first,
                      bool open, double size) {
    PageData data;
    data.set("face", std::to_string(face.number));
    data.set("open", open);
    data.set("title", face_title(face, found));
    data.set("certificate", certificate_words(found));
    data.set("rests", found.certificate.complete.value_or(false));
    data.set("why", found.certificate.why);
    data.set("surface",
             surface_words(face.kind) + " of degree " + std::to_string(face.surface.u_degree()) + " × " +
                 std::to_string(face.surface.v_degree()) + ", " + std::to_string(face.surface.u_pole_count()) + " × " +
                 std::to_string(face.surface.v_pole_count()) + " control points" +
                 (face.surface.rational() ? ", rational" : "") +
                 (found.statistics.patches > 0
                      ? "; Bézier patches: " + readable_count(static_cast<std::uint64_t>(found.statistics.patches)) +
                            ", boxes searched: " + readable_count(static_cast<std::uint64_t>(found.statistics.boxes))
                      : ""));
    const std::size_t rows = std::min(most_rows, found.umbilics.size());
    data.set("picture", parameter_picture_svg(face, found, found.umbilics.empty() ? 0 : entries[first].number,
                                              found.umbilics.size() <= most_labels));
    PageData table{PageData::type::list};
    for (std::size_t i = first; i < first + rows; ++i) table.push_back(row(entries[i], i < most_patterns, size));
    data.set("rows", table);
    data.set("has_rows", rows > 0);
    data.set("left_out", rows < found.umbilics.size());
    data.set("notes", lines(face_notes(found)));
    return data;
}

std::string omega_plane(const std::vector<Entry>& entries, std::vector<std::string>& infinite) {
    std::vector<OmegaMark> marks;
    for (const Entry& entry : entries) {
        if (entry.umbilic->containment == Containment::outside) continue;
        const UmbilicClass& kind = entry.umbilic->kind;
        if (!kind.omega) {
            infinite.push_back(std::to_string(entry.number));
            continue;
        }
        const std::complex<double> omega = entry.face->reversed ? std::conj(*kind.omega) : *kind.omega;
        marks.push_back({omega, kind.uncertainty.omega.value_or(0.0), kind.type,
                         entries.size() <= most_labels ? std::to_string(entry.number) : ""});
    }
    return omega_plane_svg(marks);
}

std::string scene(const UmbilicsReportInput& input, const SceneMesh& mesh, const std::vector<Entry>& entries) {
    BoundingBox box;
    for (const Vector3& point : mesh.points) box.add(point);
    if (box.empty()) box.add(Vector3::Zero());
    const Vector3 center = box.center();
    const auto points_json = [&](const std::vector<Vector3>& points) {
        Json list = Json::array();
        for (const Vector3& point : points) list.push_back(vector_json(point - center));
        return list;
    };
    Json umbilics = Json::array();
    for (const Entry& entry : entries) {
        const Umbilic& umbilic = *entry.umbilic;
        Json directions = Json::array();
        for (const Vector3& direction : umbilic.directions) directions.push_back(vector_json(direction));
        const Vector2 native = native_parameters(*entry.face, umbilic.at.u, umbilic.at.v);
        umbilics.push_back(
            {{"point", vector_json(umbilic.point - center)},
             {"type", name(umbilic.kind.type)},
             {"directions", std::move(directions)},
             {"face", entry.face->number},
             {"outside", umbilic.containment == Containment::outside},
             {"label", std::to_string(entry.number) + " " + type_words(umbilic) + ", face " +
                           std::to_string(entry.face->number) + ", u " + readable(native.x(), 6) + ", v " +
                           readable(native.y(), 6) + ", κ " + readable(umbilic.kappa, "1/mm")}});
    }
    Json curves = Json::array();
    for (const FaceUmbilics& found : input.umbilics)
        for (const UmbilicLine& line : found.lines) curves.push_back(points_json(line.points));
    Json types = Json::object(), faces = Json::object();
    for (const UmbilicType type : all_types)
        types[name(type)] = {{"color", hex(color_of(type))}, {"path", mark_path(type)}};
    for (const FaceUmbilics& found : input.umbilics) {
        const Face& face = input.model.face(found.face);
        faces[std::to_string(found.face)] = !found.regions.empty()       ? "region"
                                            : worth_showing(face, found) ? "shown"
                                                                         : "plain";
    }
    return script_text({{"mesh", mesh_json(mesh, center)},
                        {"umbilics", std::move(umbilics)},
                        {"curves", std::move(curves)},
                        {"types", std::move(types)},
                        {"faces", std::move(faces)},
                        {"diagonal", number_json(box.diagonal())}});
}

PageData facts(const Model& model, const UmbilicOptions& options) {
    PageData list{PageData::type::list};
    const auto fact = [&](const std::string& what, const std::string& value) {
        list.push_back(entry({{"what", what}, {"value", value}}));
    };
    fact("File", base_name(model.source.path));
    fact("Format, unit", model.source.format + ", " + model.source.unit);
    fact("Size", readable_count(model.source.bytes) + " bytes");
    fact("SHA-256", model.source.sha256);
    fact("Faces", readable_count(model.faces.size()));
    fact("Area", readable(model.area, "mm²"));
    fact("Smallest box of the search", readable(options.resolution) + " of the domain");
    fact("Most boxes on a patch", readable_count(static_cast<std::uint64_t>(options.boxes_per_patch)));
    fact("Assumed error of cubic forms", readable(options.generic_margin) + ", relative");
    fact("Assumed error of control points",
         options.accuracy > 0.0 ? readable(options.accuracy, "mm") : std::string("rounding and conversion only"));
    return list;
}

PageData skipped(const Model& model) {
    std::vector<std::string> texts;
    for (const Skipped& entry : model.skipped)
        texts.push_back((entry.face > 0 ? "Face " + std::to_string(entry.face) : entry.entity) + ": " + entry.why);
    return lines(texts);
}

}  // namespace

std::string umbilics_html(const UmbilicsReportInput& input, const Progress& progress) {
    progress.report(0.0, "tracing lines of curvature");
    std::vector<Entry> entries = numbered(input);
    tbb::parallel_for(std::size_t{0}, std::min(most_patterns, entries.size()), [&](std::size_t i) {
        progress.check();
        entries[i].pattern = trace_pattern(*entries[i].face, *entries[i].umbilic, entries[i].found->umbilics, progress);
    });
    progress.report(0.5, "drawing the pictures");
    SceneMesh mesh = scene_mesh(input.model, input.meshes);
    compute_normals(mesh);

    PageData page;
    set_scripts(page_umbilics_viewer(), scene(input, mesh, entries), page);
    page.set("name", base_name(input.model.source.path));

    const UmbilicCounts counts = count_umbilics(input.model, input.umbilics);
    page.set("headline", umbilics_headline(counts));
    page.set("explanation", umbilics_explanation(counts));
    PageData types{PageData::type::list};
    for (const UmbilicType type : all_types) {
        types.push_back(entry({{"name", name(type)}, {"mark", mark_svg(type, 0.0, 0.0, 1.0)}}));
    }
    page.set("types", types);
    page.set("has_umbilics", !entries.empty());
    page.set("views", pictures(umbilics_views(mesh, input.umbilics)));

    std::vector<std::string> infinite;
    page.set("omega_plane", omega_plane(entries, infinite));
    std::string at_infinity;
    for (const std::string& number : infinite) at_infinity += (at_infinity.empty() ? "" : ", ") + number;
    page.set("has_infinite", !infinite.empty());
    page.set("at_infinity", at_infinity);

    PageData sections{PageData::type::list};
    // Faces with isolated umbilics come first.
    struct Shown {
        const FaceUmbilics* found;
        std::size_t first;  ///< of its umbilics among all
    };
    std::vector<Shown> shown;
    std::size_t first = 0;
    for (const FaceUmbilics& found : input.umbilics) {
        if (worth_showing(input.model.face(found.face), found)) shown.push_back({&found, first});
        first += found.umbilics.size();
    }
    std::ranges::stable_partition(shown, [](const Shown& entry) { return !entry.found->umbilics.empty(); });
    for (std::size_t i = 0; i < std::min(most_faces, shown.size()); ++i) {
        progress.check();
        sections.push_back(face_section(input.model.face(shown[i].found->face), *shown[i].found, entries,
                                        shown[i].first, i < open_faces, input.model.box.diagonal()));
    }
    page.set("sections", sections);
    page.set("has_sections", !shown.empty());
    page.set("faces_left_out", shown.size() > most_faces);
    page.set("faces_left_out_count", counted(shown.size() - std::min(shown.size(), most_faces), "more face"));
    PageData groups{PageData::type::list};
    for (const FaceGroup& group : plain_faces(input.model, input.umbilics)) {
        groups.push_back(entry({{"words", group.words},
                                {"faces", number_ranges(group.faces)},
                                {"count", readable_count(group.faces.size())}}));
    }
    page.set("groups", groups);
    PageData shells{PageData::type::list};
    for (const ShellGroup& group : shell_groups(input.shells)) {
        shells.push_back(entry(
            {{"words", group.words}, {"faces", number_ranges(group.faces)}, {"count", readable_count(group.shells)}}));
    }
    page.set("shells", shells);
    page.set("has_shells", !shells.list_value().empty());
    page.set("has_groups", !groups.list_value().empty());
    page.set("skipped", skipped(input.model));
    page.set("has_skipped", !input.model.skipped.empty());
    page.set("facts", facts(input.model, input.options));
    set_repetition(input.command_line, page);
    return rendered(page_umbilics(), "Umbilics of " + base_name(input.model.source.path), page);
}

}  // namespace umbilic
