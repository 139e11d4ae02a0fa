// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <kainjow/mustache.hpp>

#include <report/parameters.h>
#include <report/views.h>

namespace umbilic {

/// Values that a page's template shows; escaping is the template engine's work.
using PageData = kainjow::mustache::data;

/// One row or entry from keys and texts.
PageData entry(std::initializer_list<std::pair<const char*, std::string>> fields);
/// One entry `text` a line.
PageData lines(const std::vector<std::string>& texts);
/// Entries `caption` and `source`, the picture itself.
PageData pictures(const std::vector<View>& views);

/// The table of page/parameters.html.
void set_parameters(const std::vector<Parameter>& parameters, PageData& page);
/// How to repeat it: `command_line`, `version`, `commit`, `opencascade`, and when it was `made`.
void set_repetition(const std::string& command_line, PageData& page);
/// What page/scripts.html runs: a viewer on page_stage() and the scene it shows, as JSON.
void set_scripts(std::string viewer, std::string scene, PageData& page);

/// The page of a template with the parts that all pages share: head, table of parameters, scripts.
std::string rendered(const std::string& page_template, const std::string& title, PageData& page);

}  // namespace umbilic
