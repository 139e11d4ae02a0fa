// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_command.h"

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace umbilic {

namespace {

constexpr std::chrono::seconds longest_run{120};
constexpr std::chrono::milliseconds poll_interval{5};

std::string contents(std::FILE* file) {
    std::rewind(file);
    std::string text;
    char buffer[65536];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
    std::fclose(file);
    return text;
}

}  // namespace

CommandResult run_umbilic(const std::vector<std::string>& words, const std::function<void(int)>& meanwhile) {
    std::FILE* const output = std::tmpfile();
    std::FILE* const error = std::tmpfile();
    if (output == nullptr || error == nullptr) throw std::runtime_error("no temporary file");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, fileno(output), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(error), STDERR_FILENO);
    std::vector<char*> arguments{const_cast<char*>(UMBILIC_COMMAND)};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int spawned = posix_spawn(&process, UMBILIC_COMMAND, &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (spawned != 0) throw std::runtime_error(std::string("cannot start ") + UMBILIC_COMMAND);
    if (meanwhile) meanwhile(process);
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    while (waitpid(process, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() - start > longest_run) kill(process, SIGKILL);
        std::this_thread::sleep_for(poll_interval);
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(error)};
}

std::string model_path(const std::string& name) {
    return std::string(UMBILIC_MODELS_DIR) + "/" + name;
}

}  // namespace umbilic
