// SPDX-License-Identifier: LGPL-2.1-or-later
#include <report/page_data.h>

#include <cassert>
#include <ctime>

#include <boost/algorithm/string/replace.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <report/base64.h>
#include <report/page.h>
#include <report/readable.h>
#include <report/versions.h>

namespace umbilic {

PageData entry(std::initializer_list<std::pair<const char*, std::string>> fields) {
    PageData data;
    for (const auto& [key, value] : fields) data.set(key, value);
    return data;
}

PageData lines(const std::vector<std::string>& texts) {
    PageData list{PageData::type::list};
    for (const std::string& text : texts) list.push_back(entry({{"text", text}}));
    return list;
}

PageData pictures(const std::vector<View>& views) {
    PageData list{PageData::type::list};
    for (const View& view : views)
        list.push_back(entry({{"caption", view.caption}, {"source", "data:image/png;base64," + base64(view.png)}}));
    return list;
}

void set_parameters(const std::vector<Parameter>& parameters, PageData& page) {
    PageData rows{PageData::type::list};
    for (const Parameter& parameter : parameters) {
        const std::string value = parameter.value.is_string()         ? parameter.value.get<std::string>()
                                  : parameter.value.is_number_float() ? readable(parameter.value.get<double>())
                                  : parameter.value.is_null()         ? "–"
                                                                      : parameter.value.dump();
        rows.push_back(entry({{"name", parameter.name},
                              {"value", value},
                              {"unit", parameter.unit == "1" ? "" : parameter.unit},
                              {"origin", name(parameter.origin)},
                              {"meaning", boost::replace_all_copy(parameter.meaning, "<=", "≤")}}));
    }
    page.set("parameters", rows);
}

void set_repetition(const std::string& command_line, PageData& page) {
    page.set("command_line", command_line);
    const Versions used = versions();
    page.set("version", used.umbilic);
    page.set("commit", used.commit);
    page.set("opencascade", used.opencascade);
    page.set("made", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
}

void set_scripts(std::string viewer, std::string scene, PageData& page) {
    page.set("has_scripts", true);
    page.set("three", page_three());
    page.set("orbit_controls", page_orbit_controls());
    page.set("stage", page_stage());
    page.set("viewer", std::move(viewer));
    page.set("scene", std::move(scene));
}

std::string rendered(const std::string& page_template, const std::string& title, PageData& page) {
    page.set("title", title);
    page.set("style", page_style());
    page.set("head", kainjow::mustache::partial(page_head));
    page.set("parameters_table", kainjow::mustache::partial(page_parameters));
    page.set("scripts", kainjow::mustache::partial(page_scripts));
    kainjow::mustache::mustache whole(page_template);
    assert(whole.is_valid());
    std::string text = whole.render(page);
    assert(whole.is_valid());
    return text;
}

}  // namespace umbilic
