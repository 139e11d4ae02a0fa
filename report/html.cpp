// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/html.h>

#include <report/html_sections.h>
#include <report/omega_plane.h>
#include <report/page.h>
#include <report/readable.h>
#include <report/scene.h>
#include <report/views.h>

namespace umbilic {

namespace {

PageData type_keys() {
    PageData list{PageData::type::list};
    for (const UmbilicType type :
         {UmbilicType::star, UmbilicType::lemon, UmbilicType::monstar, UmbilicType::non_generic}) {
        list.push_back(entry({{"name", name(type)}, {"color", hex(color_of(type))}}));
    }
    return list;
}

PageData wire_keys() {
    PageData list{PageData::type::list};
    for (const auto& [kind, words] :
         {std::pair(WireKind::maximum, "lines of the greater principal curvature"),
          std::pair(WireKind::minimum, "lines of the smaller"), std::pair(WireKind::geodesic, "geodesics"),
          std::pair(WireKind::boundary, "borders of faces")}) {
        PageData entry;
        entry.set("words", words);
        entry.set("color", hex(color_of(kind)));
        list.push_back(entry);
    }
    return list;
}

}  // namespace

std::string report_html(const ReportInput& input, const Progress& progress) {
    const Comparison& comparison = input.comparison;
    progress.report(0.0, "measuring the pictures");
    Scene scene =
        make_scene(input.original, input.original_meshes, input.suspect, input.suspect_meshes, comparison, progress);
    scene.wires = original_wires(input.original, progress.part(0.5, 0.6));
    progress.report(0.6, "drawing the pictures");
    PageData page;
    set_scripts(page_viewer(), scene_json(scene), page);
    page.set("posed", scene.posed);
    page.set("has_edges", !scene.original.edges.empty() || !scene.suspect.edges.empty());
    page.set("measured", comparison.assessment.measured);
    page.set("legend_size", legend_svg(scene.scale, false, "scale-size"));
    page.set("legend_signed", legend_svg(scene.scale, true, "scale-signed"));
    page.set("legend_printed", legend_svg(scene.scale, false, "scale-printed"));
    page.set("color_within", hex(color_within));
    page.set("color_beyond", hex(color_beyond));
    page.set("types", type_keys());
    page.set("has_umbilics", !scene.umbilics.empty());
    const SimilarityTransform shown =
        scene.posed ? comparison.alignment.original_suspect.inverse() : SimilarityTransform();
    page.set("model_views", pictures(model_views(scene, shown)));
    page.set("deviation_views", pictures(deviation_views(scene)));
    page.set("test_views", pictures(test_views(scene, comparison.assessment)));
    page.set("wireframe_views", pictures(wireframe_views(scene)));
    page.set("has_wires", !scene.wires.nodes.empty());
    page.set("wires_step", readable(scene.wires.step, "mm", 3));
    page.set("wire_kinds", wire_keys());
    page.set("omega_plane", omega_plane_svg(input.original, input.suspect,
                                            scene.posed && comparison.alignment.original_suspect.mirrored));
    progress.report(0.9, "writing the page");
    set_summary(input, page);
    set_decisions(comparison.verdict, page);
    set_exhibits(input.original, input.suspect, page);
    set_alignment(comparison.alignment, page);
    set_statistics(comparison.assessment, page);
    set_umbilics(input, page);
    set_provenance(input, page);
    return rendered(
        page_report(),
        base_name(input.suspect.source().path) + " compared with " + base_name(input.original.source().path), page);
}

}  // namespace umbilic
