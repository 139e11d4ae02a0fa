// SPDX-License-Identifier: LGPL-2.1-or-later
// The command as its users see it: words in, exit status, text and files out.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "command_fixture.h"

namespace umbilic {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Command = CommandTest;

TEST_F(Command, TellsItsVersion) {
    const CommandResult result = run_umbilic({"--version"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.output.rfind("umbilic ", 0), 0u);
    EXPECT_NE(result.output.find("OpenCASCADE 7."), std::string::npos);
}

TEST_F(Command, HelpNamesEveryOptionOnce) {
    const CommandResult result = run_umbilic({"compare", "--help"});
    EXPECT_EQ(result.status, 0);
    for (const char* const option :
         {"--method", "--scale", "--mirror", "--scope", "--initial", "--pairs", "--algorithm", "--json", "--threads",
          "--quiet", "--verbose", "--seed", "--report", "--fail-on", "--distance", "--kappa", "--direction",
          "--umbilic_distance", "--cell"}) {
        EXPECT_NE(result.output.find(option), std::string::npos) << option;
    }
}

TEST_F(Command, WrongUseIsTwo) {
    const std::string bottle = model_path("bottle.step");
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"frobnicate"},
        {"info"},
        {"info", bottle, "--no-such-option"},
        {"info", bottle, "--threads", "many"},
        {"info", bottle, "--threads", "-1"},
        {"info", bottle, "--quiet", "--verbose"},
        {"umbilics", bottle, "--tolerance", "-0.1"},
        {"umbilics", bottle, "--face", "0"},
        {"compare", bottle},
        {"compare", bottle, bottle, "--scale", "2:1"},
        {"compare", bottle, bottle, "--scale", "big"},
        {"compare", bottle, bottle, "--scale", "nan:1"},
        {"compare", bottle, bottle, "--method", "magic"},
        {"compare", bottle, bottle, "--algorithm", "3"},
        {"compare", bottle, bottle, "--distance", "0"},
        {"compare", bottle, bottle, "--cell", "2"},
        {"compare", bottle, bottle, "--fail-on", "always"},
    };
    for (const auto& words : wrong) {
        const CommandResult result = run_umbilic(words);
        const std::string last = words.empty() ? "nothing" : words.back();
        EXPECT_EQ(result.status, 2) << last;
        EXPECT_TRUE(is_one_line(result, "")) << last;
        EXPECT_TRUE(result.output.empty()) << last;
    }
}

TEST_F(Command, SaysWhatANumberMustBe) {
    const std::string bottle = model_path("bottle.step");
    struct Option {
        std::vector<std::string> words;
        bool zero_too = false;
    };
    const std::vector<Option> options = {
        {{"umbilics", bottle, "--face"}},
        {{"umbilics", bottle, "--tolerance"}},
        {{"umbilics", bottle, "--umbilic_boxes"}},
        {{"umbilics", bottle, "--umbilic_margin"}, true},
        {{"umbilics", bottle, "--accuracy"}, true},
        {{"umbilics", bottle, "--umbilic_recognition"}, true},
        {{"match", bottle, bottle, "--match_seconds"}},
        {{"match", bottle, bottle, "--match_tolerance"}},
        {{"match", bottle, bottle, "--umbilic_invariant_tolerance"}},
        {{"compare", bottle, bottle, "--match_seconds"}},
        {{"compare", bottle, bottle, "--distance"}},
        {{"compare", bottle, bottle, "--kappa"}},
        {{"fit", bottle, "-o", "out.step", "--tolerance"}},
        {{"fit", bottle, "-o", "out.step", "--smooth"}},
        {{"wireframe", bottle, "--step"}},
        {{"curve", "geodesic", bottle, "--from", "0.5,0.5", "--to", "0.6,0.6", "--longest"}},
        {{"curve", "geodesic", bottle, "--from", "0.5,0.5", "--to", "0.6,0.6", "--spacing"}, true},
    };
    for (const Option& option : options)
        for (const std::string number : {"-1", "0", "nan", "inf", "1e999", "many"}) {
            if (number == "0" && option.zero_too) continue;
            std::vector<std::string> words = option.words;
            const std::string name = words.back();
            words.push_back(number);
            const CommandResult result = run_umbilic(words);
            SCOPED_TRACE(name + " " + number);
            EXPECT_EQ(result.status, 2);
            EXPECT_TRUE(is_one_line(result, option.zero_too ? "must be 0 or a positive number, not '" + number + "'"
                                                            : "must be a positive number, not '" + number + "'"))
                << result.error;
            EXPECT_NE(result.error.find(name), std::string::npos) << result.error;
            EXPECT_LT(result.error.size(), 160u) << result.error;
        }
}

TEST_F(Command, BadInputIsThree) {
    const std::vector<std::string> bad = {path("missing.step"),
                                          folder_.string(),
                                          make_file("empty.step", ""),
                                          make_file("prose.step", "This is no CAD file.\n"),
                                          make_file("noise.igs", std::string(4096, '\xfe')),
                                          model_path("malformed/truncated.step"),
                                          model_path("malformed/no_face.step")};
    for (const std::string& input : bad) {
        const CommandResult result = run_umbilic({"info", input});
        EXPECT_EQ(result.status, 3) << input << ": " << result.error;
        EXPECT_TRUE(is_one_line(result, fs::path(input).filename().string())) << input;
        EXPECT_TRUE(result.output.empty()) << input;
    }
    const CommandResult second = run_umbilic({"compare", model_path("bottle.step"), path("missing.step")});
    EXPECT_EQ(second.status, 3);
    EXPECT_TRUE(is_one_line(second, "missing.step"));
}

TEST_F(Command, FilesThatMayNotBeReadAreThree) {
    if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const std::string secret = make_file("secret.step", "ISO-10303-21;");
    fs::permissions(secret, fs::perms::none);
    const CommandResult result = run_umbilic({"info", secret});
    EXPECT_EQ(result.status, 3);
    EXPECT_TRUE(is_one_line(result, "secret.step"));
}

TEST_F(Command, GivenPosesThatAreNoneAreThree) {
    const std::string bottle = model_path("bottle.step");
    const std::vector<std::string> transforms = {
        "",
        "{}",
        "[1]",
        R"({"scale": "big"})",
        R"({"scale": -1, "rotation": [[1,0,0],[0,1,0],[0,0,1]], "translation": [0,0,0]})",
        R"({"scale": 1, "rotation": [[1,0,0],[0,1,0],[0,0,-1]], "translation": [0,0,0]})",
        R"({"scale": 1, "rotation": [[2,0,0],[0,1,0],[0,0,1]], "translation": [0,0,0]})"};
    for (const std::string& text : transforms) {
        const CommandResult result = run_umbilic({"match", bottle, bottle, "--initial", make_file("t.json", text)});
        EXPECT_EQ(result.status, 3) << text;
        EXPECT_TRUE(is_one_line(result, "t.json")) << text;
    }
    const std::vector<std::pair<std::string, std::string>> pairs = {
        {"", "no pair"},
        {"x,y,z\n", "no pair"},
        {"x,y,z,x,y,z\nx,y,z,x,y,z\n", "line 2"},
        {"1,2,3,4,5\n", "line 1 holds 5 values"},
        {"nan,2,3,4,5,6\n", "line 1: 'nan'"},
        {"1,2,3,4,5,6\n1,2,3,4,5\n", "line 2 holds 5 values"},
        {"1,2,3,4,5,6\n\n1,2,3,4,5,6,7\n", "line 3 holds 7 values"},
        {"1,2,3,4,5,6\n1,2,3,4,5,six\n", "line 2: 'six'"},
        {"1,2,3,4,5,6\n1,2,3,4,inf,6\n", "line 2: 'inf'"},
        {"x y z x y z\n1 2 3 4 5 6\n1 2 4 4 5 7\n", "line 3, the last one: corresponding points: 2 pairs are too few"},
        {"0,0,0,0,0,0\n1,0,0,1,0,0\n2,0,0,2,0,1\n",
         "line 3, the last one: corresponding points: those of the original"},
        {"0,0,0,0,0,0\n1,0,0,1,0,0\n2,1,0,2,0,0\n",
         "line 3, the last one: corresponding points: those of the suspect"}};
    for (const auto& [text, complaint] : pairs) {
        const CommandResult result = run_umbilic({"match", bottle, bottle, "--pairs", make_file("p.csv", text)});
        EXPECT_EQ(result.status, 3) << text;
        EXPECT_TRUE(is_one_line(result, "p.csv: " + complaint) || is_one_line(result, "p.csv: holds " + complaint))
            << text << result.error;
    }
}

TEST_F(Command, InfoGivesTextAndJson) {
    const CommandResult text = run_umbilic({"info", model_path("bracket.step")});
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.output.find("cylinder"), std::string::npos);
    EXPECT_EQ(text.output.find('\033'), std::string::npos);  // no colours where no terminal is
    EXPECT_TRUE(text.error.empty()) << text.error;
    const CommandResult structured = run_umbilic({"info", model_path("bracket.step"), "--json", "-"});
    const json result = json::parse(structured.output);
    EXPECT_EQ(result.at("schema"), "umbilic.info/1");
    EXPECT_EQ(result.at("faces").size(), 19u);
    EXPECT_EQ(result.at("input").at("solids"), 1);
    const CommandResult quiet = run_umbilic({"info", model_path("bracket.step"), "--quiet", "--json", path("i.json")});
    EXPECT_TRUE(quiet.output.empty());
    EXPECT_EQ(json::parse(read("i.json")), result);
    EXPECT_EQ(entries(), std::vector<std::string>{"i.json"});
}

TEST_F(Command, UmbilicsOfOneFaceOrAll) {
    const std::string file = model_path("monge_umbilics.step");
    const CommandResult all = run_umbilic({"umbilics", file, "--json", "-"});
    ASSERT_EQ(all.status, 0) << all.error;
    const json result = json::parse(all.output);
    EXPECT_EQ(result.at("schema"), "umbilic.umbilics/1");
    EXPECT_EQ(result.at("faces").at(0).at("umbilics").size(), 5u);
    const CommandResult one = run_umbilic({"umbilics", file, "--face", "1", "--json", "-"});
    const json alone = json::parse(one.output);
    EXPECT_EQ(alone.at("faces"), result.at("faces"));
    EXPECT_TRUE(alone.at("shells").empty());
    EXPECT_EQ(result.at("shells").size(), 1u);
    const CommandResult none = run_umbilic({"umbilics", file, "--face", "99"});
    EXPECT_EQ(none.status, 2);
    EXPECT_TRUE(is_one_line(none, "no face 99"));
    const CommandResult text = run_umbilic({"umbilics", file});
    EXPECT_NE(text.output.find("monstar"), std::string::npos);
}

TEST_F(Command, UmbilicsWriteAWholeReport) {
    const CommandResult result = run_umbilic(
        {"umbilics", model_path("monge_umbilics.step"), "--report", path("report"), "--json", path("same.json")});
    ASSERT_EQ(result.status, 0) << result.error;
    EXPECT_EQ(entries(),
              (std::vector<std::string>{"report", "report/report.html", "report/umbilics.json", "same.json"}));
    EXPECT_EQ(read("report/umbilics.json"), read("same.json"));
    EXPECT_NE(result.output.find("5 isolated umbilics: 4 stars and 1 monstar"), std::string::npos);
    EXPECT_NE(result.output.find("complete: every umbilic of this face is listed; proved"), std::string::npos);
    EXPECT_NE(result.output.find("open; completeness not evaluated: the shell is open, with 4 free edges"),
              std::string::npos)
        << result.output;
    EXPECT_EQ(json::parse(read("same.json")).at("shells").size(), 1u);
    EXPECT_NE(result.output.find(path("report/report.html")), std::string::npos);
    for (const json& umbilic : json::parse(read("same.json")).at("faces").at(0).at("umbilics")) {
        EXPECT_TRUE(umbilic.at("neighbours").empty());
        EXPECT_GT(umbilic.at("margin").get<double>(), 0.0);
        EXPECT_EQ(umbilic.at("ridges"), 1);
        EXPECT_LT(umbilic.at("uncertainty").at("kappa").get<double>(), 1e-9);
    }
    const CommandResult rough =
        run_umbilic({"umbilics", model_path("monge_umbilics.step"), "--accuracy", "0.1", "--json", "-"});
    for (const json& umbilic : json::parse(rough.output).at("faces").at(0).at("umbilics")) {
        EXPECT_EQ(umbilic.at("type"), "non-generic");
        EXPECT_GE(umbilic.at("neighbours").size(), 2u);
        EXPECT_TRUE(umbilic.at("certified").get<bool>());
    }
    const CommandResult nowhere = run_umbilic({"umbilics", model_path("torus.step"), "--report", path("same.json")});
    EXPECT_EQ(nowhere.status, 4);
    EXPECT_TRUE(is_one_line(nowhere, "same.json"));
}

TEST_F(Command, JsonThatDoesNotArriveIsFour) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    for (const std::string& target : {std::string("/dev/full"), path("missing/i.json"), folder_.string()}) {
        const CommandResult result = run_umbilic({"info", model_path("bracket.step"), "--quiet", "--json", target});
        EXPECT_EQ(result.status, 4) << target;
        EXPECT_TRUE(is_one_line(result, target)) << target;
    }
    EXPECT_TRUE(entries().empty());
}

TEST_F(Command, CompareWritesAWholeReport) {
    const CommandResult result = run_umbilic({"compare", model_path("bottle.step"), model_path("bottle_suspect.igs"),
                                              "--report", path("report"), "--json", path("same.json")});
    ASSERT_EQ(result.status, 0) << result.error;
    EXPECT_EQ(entries(), (std::vector<std::string>{"report", "report/aligned.step", "report/deviation.csv",
                                                   "report/report.html", "report/result.json", "same.json"}));
    EXPECT_EQ(read("report/result.json"), read("same.json"));
    const json compared = json::parse(read("same.json"));
    EXPECT_EQ(compared.at("schema"), "umbilic.compare/1");
    EXPECT_EQ(compared.at("verdict").at("level"), "strong");
    EXPECT_NEAR(compared.at("alignment").at("scale").get<double>(), 1.0 / 0.37, 1e-5);
    // The plain answer comes first.
    EXPECT_EQ(result.output.rfind(compared.at("answer").at("text").get<std::string>(), 0), 0u);
    EXPECT_NE(result.output.find(path("report/report.html")), std::string::npos);
    EXPECT_NE(read("report/report.html").find("bottle_suspect.igs"), std::string::npos);
    // What was written as aligned lies where the original is.
    const CommandResult again =
        run_umbilic({"match", model_path("bottle.step"), path("report/aligned.step"), "--json", "-"});
    const json pose = json::parse(again.output).at("alignment");
    EXPECT_NEAR(pose.at("scale").get<double>(), 1.0, 1e-6);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(pose.at("translation").at(i).get<double>(), 0.0, 1e-3);
}

TEST_F(Command, FailOnTellsTheLevelByTheStatus) {
    const std::string bottle = model_path("bottle.step");
    EXPECT_EQ(run_umbilic({"compare", bottle, model_path("bottle_suspect.igs"), "--fail-on", "weak"}).status, 10);
    EXPECT_EQ(run_umbilic({"compare", bottle, model_path("bottle_other.step"), "--fail-on", "weak"}).status, 0);
    EXPECT_EQ(run_umbilic({"compare", bottle, model_path("bottle_other.step"), "--fail-on", "none"}).status, 10);
}

TEST_F(Command, GivenPosesAreUsed) {
    const CommandResult found =
        run_umbilic({"match", model_path("blade.step"), model_path("blade_moved.igs"), "--json", path("pose.json")});
    ASSERT_EQ(found.status, 0) << found.error;
    const CommandResult again = run_umbilic({"match", model_path("blade.step"), model_path("blade_moved.igs"),
                                             "--initial", path("pose.json"), "--json", "-"});
    const json result = json::parse(again.output);
    EXPECT_EQ(result.at("parameters").at("initial").at("origin"), "user");
    EXPECT_EQ(result.at("schema"), "umbilic.match/1");
}

TEST_F(Command, WrongPairsAreNamed) {
    // Of the blade and its moved copy: points of the original, carried by the known pose; the fourth is wrong.
    const CommandResult found =
        run_umbilic({"match", model_path("blade.step"), model_path("blade.step"), "--json", path("pose.json")});
    ASSERT_EQ(found.status, 0) << found.error;
    const std::string pairs = make_file("pairs.csv",
                                        "original,,,suspect,,\n0,0,0,0,0,0\n10,0,0,10,0,0\n0,10,0,0,10,0\n"
                                        "0,0,10,5,5,5\n10,10,0,10,10,0\n# a remark\n3,-4,5,3,-4,5\n");
    const CommandResult again = run_umbilic(
        {"match", model_path("blade.step"), model_path("blade.step"), "--pairs", pairs, "--json", path("match.json")});
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_NE(again.output.find("6 given"), std::string::npos) << again.output;
    EXPECT_NE(again.output.find("number 4 (off by 8.66 mm)"), std::string::npos) << again.output;
    const json judged = json::parse(read("match.json")).at("alignment").at("pairs");
    ASSERT_EQ(judged.size(), 6u);
    for (std::size_t k = 0; k < judged.size(); ++k) {
        EXPECT_EQ(judged[k].at("outlier"), k == 3) << k;
        EXPECT_NEAR(judged[k].at("residual"), k == 3 ? std::sqrt(75.0) : 0.0, 1e-9) << k;
    }
    EXPECT_TRUE(json::parse(read("pose.json")).at("alignment").at("pairs").empty());
}

TEST_F(Command, SameResultWhateverTheThreads) {
    const auto result_with = [&](const char* threads) {
        const CommandResult run = run_umbilic({"compare", model_path("bottle.step"), model_path("bottle_suspect.igs"),
                                               "--threads", threads, "--json", "-"});
        json result = json::parse(run.output);
        result.erase("timing");
        return result.dump();
    };
    EXPECT_EQ(result_with("1"), result_with("2"));
}

TEST_F(Command, InterruptLeavesNothingBehind) {
    // Interrupted at several moments; a run that was faster than the signal must be whole.
    for (const int milliseconds : {5, 50, 200, 400, 800}) {
        const std::string report = "report" + std::to_string(milliseconds);
        const CommandResult result =
            run_umbilic({"compare", model_path("bottle.step"), model_path("bottle_suspect.igs"), "--report",
                         path(report), "--json", path(report + ".json")},
                        [&](int process) {
                            std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
                            kill(process, SIGINT);
                        });
        const bool before_handler = result.status == -1;  // the signal came before the program could take it
        if (result.status == 0) {
            EXPECT_TRUE(fs::exists(path(report + "/report.html")));
            fs::remove_all(path(report));
            fs::remove(path(report + ".json"));
        } else if (!before_handler) {
            EXPECT_EQ(result.status, 4) << result.error;
            EXPECT_TRUE(is_one_line(result, "stopped; nothing was written"));
        }
        EXPECT_TRUE(entries().empty()) << milliseconds << " ms: " << entries().front();
    }
}

TEST_F(Command, ReportsThatCannotBeWrittenAreFour) {
    for (const std::string& target : {std::string("/dev/full"), make_file("file", "text")}) {
        const CommandResult result =
            run_umbilic({"compare", model_path("bottle.step"), model_path("bottle_suspect.igs"), "--report", target});
        EXPECT_EQ(result.status, 4) << target;
        EXPECT_TRUE(is_one_line(result, target)) << target;
    }
    EXPECT_EQ(entries(), std::vector<std::string>{"file"});
    EXPECT_EQ(read("file"), "text");
}

}  // namespace
}  // namespace umbilic
