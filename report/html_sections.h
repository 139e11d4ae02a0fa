// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <report/html.h>
#include <report/page_data.h>

namespace umbilic {

/// Answer, level and key figures.
void set_summary(const ReportInput& input, PageData& page);
/// Both decision algorithms, step by step.
void set_decisions(const Verdict& verdict, PageData& page);
/// Both files side by side.
void set_exhibits(const PreparedShape& original, const PreparedShape& suspect, PageData& page);
/// Pose, runners-up, symmetries.
void set_alignment(const Alignment& alignment, PageData& page);
/// Statistics of both directions, local similarity, faces.
void set_statistics(const Assessment& assessment, PageData& page);
/// Isolated umbilics of both models and their pairs.
void set_umbilics(const ReportInput& input, PageData& page);
/// Parameters, command line, versions, timing.
void set_provenance(const ReportInput& input, PageData& page);

}  // namespace umbilic
