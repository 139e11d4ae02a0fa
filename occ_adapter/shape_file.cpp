// SPDX-License-Identifier: LGPL-2.1-or-later
#include "shape_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <BinTools_ShapeSet.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <StepData_StepModel.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <TDocStd_Document.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <umbilic/core/errors.h>

#include "document_attributes.h"
#include "kernel_progress.h"
#include "knot_check.h"

namespace umbilic {

namespace {

/// Two conversion factors are the same unit if they agree to this relative accuracy (some systems write 25.4 as
/// 25.3999999).
constexpr double unit_accuracy = 1e-6;

std::string unit_word(double in_mm) {
    struct Unit {
        const char* word;
        double in_mm;
    };
    constexpr Unit units[] = {{"mm", 1.0},       {"cm", 10.0},         {"inch", 25.4},        {"foot", 304.8},
                              {"metre", 1000.0}, {"micrometre", 1e-3}, {"yard", 914.4},       {"kilometre", 1e6},
                              {"mil", 0.0254},   {"mile", 1609344.0},  {"microinch", 2.54e-5}};
    for (const Unit& unit : units)
        if (std::abs(in_mm - unit.in_mm) <= unit_accuracy * unit.in_mm) return unit.word;
    std::ostringstream text;
    text << in_mm << " mm";
    return text.str();
}

std::string first_failure(const Interface_CheckIterator& checks) {
    for (Interface_CheckIterator it = checks; it.More(); it.Next())
        if (it.Value()->NbFails() > 0) return it.Value()->CFail(1);
    return "";
}

std::string first_failure(const XSControl_WorkSession& session) {
    const Handle(XSControl_TransferReader) reader = session.TransferReader();
    if (reader.IsNull() || reader->TransientProcess().IsNull()) return "";
    return first_failure(reader->TransientProcess()->CheckList(Standard_True));
}

double step_unit_in_mm(const Handle(StepData_StepModel) & model) {
    for (int i = 1; i <= model->NbEntities(); ++i) {
        const Handle(Standard_Transient) entity = model->Value(i);
        Handle(StepRepr_GlobalUnitAssignedContext) context =
            Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
        if (const auto full =
                Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity))
            context = full->GlobalUnitAssignedContext();
        if (const auto certain =
                Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(entity))
            context = certain->GlobalUnitAssignedContext();
        if (context.IsNull()) continue;
        STEPConstruct_UnitContext units;
        units.ComputeFactors(context);
        if (units.LengthDone()) return units.LengthFactor();
    }
    return 1.0;
}

/// Length units of the global section of an IGES file by their flag; flag 3 names the unit.
double iges_unit_in_mm(const IGESData_GlobalSection& section) {
    constexpr double by_flag[] = {1.0, 25.4, 1.0, 1.0, 304.8, 1609344.0, 1000.0, 1e6, 0.0254, 1e-3, 10.0, 2.54e-5};
    const int flag = section.UnitFlag();
    if (flag > 0 && flag < static_cast<int>(std::size(by_flag)) && flag != 3) return by_flag[flag];
    const std::string name = section.UnitName().IsNull() ? "" : section.UnitName()->ToCString();
    if (name == "INCH" || name == "IN") return 25.4;
    if (name == "FT") return 304.8;
    if (name == "M") return 1000.0;
    if (name == "CM") return 10.0;
    if (name == "UM") return 1e-3;
    return 1.0;
}

/// Parses and translates a file into a document with names and colours. `format` stands in messages.
template <class Reader>
Handle(TDocStd_Document)
    translated(Reader& reader, const std::string& format, const std::string& path, const Progress& progress) {
    progress.report(0.0, "parsing " + format);
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
        throw InvalidInput("OpenCASCADE cannot parse the " + format +
                           " file; it is malformed — open it in the system that wrote it and export again");
    progress.report(0.2, "translating " + format);
    const Handle(TDocStd_Document) document = new TDocStd_Document("MDTV-XCAF");
    {
        Handle(TDocStd_Document) target = document;
        reader.Transfer(target, KernelProgress(progress.part(0.2, 0.9), "translating " + format).start());
    }
    progress.report(0.9, "translating " + format);
    return document;
}

ShapeFile read_step(const std::string& path, const Progress& progress) {
    STEPCAFControl_Reader reader;
    // Names of faces stand on sub-shapes.
    Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
    reader.SetGDTMode(Standard_False);
    reader.SetViewMode(Standard_False);
    const Handle(TDocStd_Document) document = translated(reader, "STEP", path, progress);
    ShapeFile result;
    result.format = "STEP";
    result.shape = reader.ChangeReader().OneShape();
    result.unit_in_mm = step_unit_in_mm(reader.ChangeReader().StepModel());
    result.unit = unit_word(result.unit_in_mm);
    result.first_complaint = first_failure(*reader.ChangeReader().WS());
    result.warnings = decreasing_knots(reader.ChangeReader().StepModel());
    read_attributes(document, result);
    return result;
}

ShapeFile read_iges(const std::string& path, const Progress& progress) {
    IGESCAFControl_Reader reader;
    reader.SetReadVisible(Standard_True);
    const Handle(TDocStd_Document) document = translated(reader, "IGES", path, progress);
    ShapeFile result;
    result.format = "IGES";
    result.shape = reader.OneShape();
    result.unit_in_mm = iges_unit_in_mm(reader.IGESModel()->GlobalSection());
    result.unit = unit_word(result.unit_in_mm);
    result.first_complaint = first_failure(*reader.WS());
    result.warnings = decreasing_knots(reader.IGESModel());
    read_attributes(document, result);
    return result;
}

ShapeFile read_brep_text(const std::string& path) {
    ShapeFile result;
    result.format = "BREP";
    const BRep_Builder builder;
    if (!BRepTools::Read(result.shape, path.c_str(), builder) || result.shape.IsNull())
        throw InvalidInput("OpenCASCADE cannot read the BREP file; it is malformed or cut off — export it again");
    return result;
}

/// BinTools::Write ends with 9 bytes (orientation as one byte, two integers), FreeCAD's exportBinary with three
/// integers.
ShapeFile read_brep_binary(const std::string& path) {
    constexpr std::streamoff size_of_shape_framing = 12;
    std::ifstream in(path, std::ios::binary);
    BinTools_ShapeSet set;
    set.Read(in);
    const std::streamoff here = in.tellg();
    in.seekg(0, std::ios::end);
    const std::streamoff rest = in.tellg() - here;
    in.seekg(here);
    ShapeFile result;
    if (rest == size_of_shape_framing) {
        result.format = "shape";
        int number = 0, location = 0, orientation = 0;
        BinTools::GetInteger(in, number);
        BinTools::GetInteger(in, location);
        BinTools::GetInteger(in, orientation);
        if (!in || number < 1 || number > set.NbShapes() || location < 0 || location > set.Locations().NbLocations() ||
            orientation < TopAbs_FORWARD || orientation > TopAbs_EXTERNAL)
            throw InvalidInput("the binary shape is malformed; export it again");
        result.shape = set.Shape(number);
        result.shape.Location(set.Locations().Location(location), Standard_False);
        result.shape.Orientation(static_cast<TopAbs_Orientation>(orientation));
    } else {
        result.format = "BREP";
        in.seekg(0);
        BinTools::Read(result.shape, in);
    }
    if (result.shape.IsNull())
        throw InvalidInput(
            "OpenCASCADE cannot read the binary BREP file; it is malformed or cut off — export it again");
    return result;
}

}  // namespace

ShapeFile read_shape_file(const std::string& path, const FileDescription& description, const Progress& progress) {
    switch (description.format) {
        case FileFormat::step:
            return read_step(path, progress);
        case FileFormat::iges:
            return read_iges(path, progress);
        case FileFormat::brep_text:
            return read_brep_text(path);
        case FileFormat::brep_binary:
            return read_brep_binary(path);
    }
    throw InvalidInput("its format is not known");
}

}  // namespace umbilic
