// SPDX-License-Identifier: LGPL-2.1-or-later
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include <point_files/read_points.h>
#include <umbilic/differential/recognise.h>

#include <cli/commands.h>
#include <cli/console.h>
#include <cli/exit_status.h>
#include <cli/loading.h>
#include <report/json.h>
#include <report/readable.h>

namespace umbilic {

namespace {

std::string summary(const Model& model) {
    const Source& source = model.source;
    const Vector3 size = model.box.empty() ? Vector3(Vector3::Zero()) : Vector3(model.box.high - model.box.low);
    std::string faces = readable_count(model.faces.size());
    if (model.declared_faces >= 0) faces += " of " + readable_count(model.declared_faces) + " that the file declares";
    return bold(printable(source.path)) + "\n" +
           facts({{"Format", source.format},
                  {"SHA-256", source.sha256},
                  {"Bytes", readable_count(source.bytes)},
                  {"Unit", source.unit + (source.unit == "mm" ? std::string()
                                                              : " (1 = " + readable(source.unit_in_mm, 8) + " mm)")},
                  {"Size", readable(size.x()) + " × " + readable(size.y()) + " × " + readable(size.z()) + " mm"},
                  {"Solids", readable_count(model.solids.size())},
                  {"Shells", readable_count(model.shells)},
                  {"Faces", faces},
                  {"Area", readable(model.area, "mm²", 8)},
                  {"Volume", model.solids.empty() ? std::string() : readable(model.volume, "mm³", 8)},
                  {"Valid", model.valid ? "yes" : "no"},
                  {"Skipped", model.skipped.empty() ? std::string() : readable_count(model.skipped.size())},
                  {"Repaired", model.repaired.empty() ? std::string() : readable_count(model.repaired.size())}});
}

std::string recognised_text(const RecognisedSurface& recognised) {
    const ElementarySurface& surface = recognised.surface;
    std::string text = name(recognised.kind);
    if (elementary(recognised.kind) && recognised.kind != SurfaceKind::plane)
        text += ", radius " + readable(surface.radius, "mm");
    if (recognised.kind == SurfaceKind::torus) text += " and " + readable(surface.minor_radius, "mm");
    if (recognised.kind == SurfaceKind::cone)
        text += ", half angle " + readable(surface.semi_angle * 180.0 / std::numbers::pi) + "°";
    return text + (recognised.exact ? ", exact" : ", within " + readable(recognised.deviation, "mm", 2));
}

/// NURBS faces that are some simpler surface besides.
std::string recognised_table(const Model& model, const std::vector<std::optional<RecognisedSurface>>& recognised) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < recognised.size(); ++k) {
        if (!recognised[k]) continue;
        rows.push_back(
            {std::to_string(model.faces[k].number), name(model.faces[k].kind), recognised_text(*recognised[k])});
    }
    return rows.empty() ? "" : "\n" + table({"face", "surface", "recognised as"}, rows, {0});
}

std::string face_table(const Model& model) {
    std::vector<std::vector<std::string>> rows;
    for (const Face& face : model.faces) {
        const NurbsSurface& surface = face.surface;
        rows.push_back({std::to_string(face.number), name(face.kind),
                        std::to_string(surface.u_degree()) + "×" + std::to_string(surface.v_degree()),
                        std::to_string(surface.u_pole_count()) + "×" + std::to_string(surface.v_pole_count()),
                        surface.rational() ? "yes" : "no", face.region.whole_domain() ? "no" : "yes",
                        face.reversed ? "reversed" : "forward", readable(face.area, 6), printable(face.name)});
    }
    return table({"face", "surface", "degree", "poles", "rational", "trimmed", "orientation", "area mm²", "name"}, rows,
                 {0, 2, 3, 7});
}

int run_info_of_points(const Session& session, const std::string& path) {
    const PointCloud cloud = load_points(session, path, std::numeric_limits<std::size_t>::max(), session.progress);
    clear_progress_bar();
    const BoundingBox box = cloud.box();
    const Vector3 size = box.high - box.low;
    print(session,
          bold(printable(path)) + "\n" +
              facts({{"Format", cloud.source.format + " (" + cloud.layout + ")"},
                     {"SHA-256", cloud.source.sha256},
                     {"Bytes", readable_count(cloud.source.bytes)},
                     {"Unit", cloud.source.unit},
                     {"Size", readable(size.x()) + " × " + readable(size.y()) + " × " + readable(size.z()) + " mm"},
                     {"Points", readable_count(cloud.points.size())},
                     {"Triangles", readable_count(cloud.triangles.size())},
                     {"Normals", cloud.normals.empty() ? "no" : "yes"}}));
    write_json(session, {{"schema", "umbilic.info/1"},
                         {"input", input_json(cloud)},
                         {"surfaces", Json::object()},
                         {"faces", Json::array()}});
    return exit_done;
}

}  // namespace

void add_info(CLI::App& application, Session& session, Command& command) {
    auto* const subcommand = application.add_subcommand("info", "Units, solids, faces, area, volume, what was skipped");
    const auto path = std::make_shared<std::string>();
    subcommand->add_option("FILE", *path, "STEP, IGES or BREP file, or points or a mesh")->required();
    add_common_options(*subcommand, session);
    subcommand->callback([&session, &command, path] {
        command = [&session, path] {
            if (holds_points(*path)) return run_info_of_points(session, *path);
            const ReadResult read = load(session, *path, {}, session.progress);
            clear_progress_bar();
            const auto recognised = recognise(read.model, {}, session.progress);
            print(session,
                  summary(read.model) + "\n" + face_table(read.model) + recognised_table(read.model, recognised));
            write_json(session, info_json(read.model, recognised));
            return exit_done;
        };
    });
}

}  // namespace umbilic
