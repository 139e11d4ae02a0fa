// SPDX-License-Identifier: LGPL-2.1-or-later
#include <umbilic/matching/alignment.h>

namespace umbilic {

const char* name(AlignmentStatus status) {
    switch (status) {
        case AlignmentStatus::found:
            return "found";
        case AlignmentStatus::ambiguous:
            return "ambiguous";
        case AlignmentStatus::compatible:
            return "compatible";
        case AlignmentStatus::not_found:
            return "not found";
    }
    return "not found";
}

const char* name(MatchMethod method) {
    switch (method) {
        case MatchMethod::none:
            return "none";
        case MatchMethod::given:
            return "given";
        case MatchMethod::analytic:
            return "analytic";
        case MatchMethod::umbilics:
            return "umbilics";
        case MatchMethod::umbilic_lines:
            return "umbilics-lines";
        case MatchMethod::umbilic_kh:
            return "umbilics-kh";
        case MatchMethod::moments:
            return "moments";
        case MatchMethod::curvature:
            return "curvature";
        case MatchMethod::kh:
            return "kh";
        case MatchMethod::points:
            return "points";
    }
    return "none";
}

const char* name(MatchScope scope) {
    return scope == MatchScope::global ? "global" : "partial";
}

}  // namespace umbilic
