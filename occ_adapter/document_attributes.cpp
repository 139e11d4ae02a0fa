// SPDX-License-Identifier: LGPL-2.1-or-later
#include "document_attributes.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include <TCollection_AsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_TShape.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs.hxx>
#include <XCAFPrs_IndexedDataMapOfShapeStyle.hxx>
#include <XCAFPrs_Style.hxx>

namespace umbilic {

namespace {

/// Numbers of the faces or solids of one shape; shapes of a document are found by place, else by what they are
/// instances of.
class Numbering {
public:
    Numbering(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) : type_(type) {
        TopExp::MapShapes(shape, type, map_);
        for (int i = 1; i <= map_.Extent(); ++i) instances_[map_(i).TShape().get()].push_back(i);
    }
    std::vector<int> numbers(const TopoDS_Shape& shape) const {
        if (const int number = map_.FindIndex(shape); number > 0) return {number};
        const auto found = instances_.find(shape.TShape().get());
        return found == instances_.end() ? std::vector<int>() : found->second;
    }
    /// Calls `visit` with the number of each face or solid of `shape`.
    template <class Visit>
    void for_each(const TopoDS_Shape& shape, const Visit& visit) const {
        for (TopExp_Explorer explorer(shape, type_); explorer.More(); explorer.Next())
            for (const int number : numbers(explorer.Current())) visit(number);
    }

private:
    TopAbs_ShapeEnum type_;
    TopTools_IndexedMapOfShape map_;
    std::unordered_map<const TopoDS_TShape*, std::vector<int>> instances_;
};

std::string name_of(const TDF_Label& label) {
    Handle(TDataStd_Name) name;
    if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
    const TCollection_AsciiString text(name->Get());
    return text.ToCString();
}

class Names {
public:
    explicit Names(ShapeFile& file) : file_(file), faces_(file.shape, TopAbs_FACE), solids_(file.shape, TopAbs_SOLID) {}

    void visit(const TDF_Label& label, const TopLoc_Location& location) {
        TDF_LabelSequence children;
        if (XCAFDoc_ShapeTool::IsAssembly(label)) {
            XCAFDoc_ShapeTool::GetComponents(label, children);
            for (int i = 1; i <= children.Length(); ++i) {
                TDF_Label part;
                if (XCAFDoc_ShapeTool::GetReferredShape(children(i), part))
                    visit(part, location * XCAFDoc_ShapeTool::GetLocation(children(i)));
            }
            return;
        }
        take(label, location, false);
        XCAFDoc_ShapeTool::GetSubShapes(label, children);
        for (int i = 1; i <= children.Length(); ++i) take(children(i), location, true);
    }

private:
    /// The name of a part names its solids, and its face if it has but one; that of a sub-shape is the more exact one.
    void take(const TDF_Label& label, const TopLoc_Location& location, bool sub_shape) {
        const std::string name = name_of(label);
        TopoDS_Shape shape;
        if (name.empty() || !XCAFDoc_ShapeTool::GetShape(label, shape) || shape.IsNull()) return;
        shape.Move(location, Standard_False);
        const auto set = [&](std::map<int, std::string>& names) {
            return [&](int number) {
                if (sub_shape) names[number] = name;
                names.emplace(number, name);
            };
        };
        if (shape.ShapeType() <= TopAbs_SOLID) solids_.for_each(shape, set(file_.solid_names));
        if (shape.ShapeType() == TopAbs_FACE) faces_.for_each(shape, set(file_.face_names));
    }

    ShapeFile& file_;
    Numbering faces_, solids_;
};

void read_colors(const TDF_LabelSequence& roots, ShapeFile& file) {
    XCAFPrs_IndexedDataMapOfShapeStyle styles;
    for (int i = 1; i <= roots.Length(); ++i) XCAFPrs::CollectStyleSettings(roots(i), TopLoc_Location(), styles);
    std::vector<int> order;
    for (int i = 1; i <= styles.Extent(); ++i) order.push_back(i);
    // The colour of a face wins over that of its solid, and so on: TopAbs_ShapeEnum runs from large to small.
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return styles.FindKey(a).ShapeType() < styles.FindKey(b).ShapeType(); });
    const Numbering faces(file.shape, TopAbs_FACE);
    for (const int i : order) {
        if (!styles(i).IsSetColorSurf()) continue;
        std::array<double, 3> color{};
        styles(i).GetColorSurf().Values(color[0], color[1], color[2], Quantity_TOC_sRGB);
        faces.for_each(styles.FindKey(i), [&](int number) { file.face_colors[number] = color; });
    }
}

}  // namespace

void read_attributes(const Handle(TDocStd_Document) & document, ShapeFile& file) {
    if (file.shape.IsNull()) return;
    const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    TDF_LabelSequence roots;
    shapes->GetFreeShapes(roots);
    Names names(file);
    for (int i = 1; i <= roots.Length(); ++i) names.visit(roots(i), TopLoc_Location());
    read_colors(roots, file);
}

}  // namespace umbilic
