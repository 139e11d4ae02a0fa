// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reader_process.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <umbilic/core/errors.h>

namespace umbilic {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The caller hears of progress, and may cancel, at least this often.
constexpr std::chrono::milliseconds heartbeat(100);

constexpr std::size_t read_piece = std::size_t(1) << 16;

/// Nothing the reader sends is longer, so a longer frame is a damaged one.
constexpr std::uint64_t longest_frame = std::uint64_t(1) << 36;

class FileDescriptor {
public:
    explicit FileDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    ~FileDescriptor() { close(); }
    int get() const { return descriptor_; }
    void close() {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = -1;
    }

private:
    int descriptor_;
};

/// A child process that does not outlive this object.
class Child {
public:
    explicit Child(pid_t pid) : pid_(pid) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (pid_ <= 0) return;
        ::kill(pid_, SIGKILL);
        wait();
    }
    /// Waits for the end and returns the status as of waitpid(); nothing if someone else has collected the child.
    std::optional<int> wait() {
        int status = 0;
        pid_t done = 0;
        do {
            done = ::waitpid(pid_, &status, 0);
        } while (done < 0 && errno == EINTR);
        const bool collected = done == pid_;
        pid_ = -1;
        return collected ? std::optional(status) : std::nullopt;
    }

private:
    pid_t pid_;
};

[[noreturn]] void throw_system_error(const std::string& what, int error) {
    throw NumericFailure(what + " (" + std::strerror(error) + "); close other programs and try again");
}

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, int output) {
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, reader_output);
    posix_spawn_file_actions_addclosefrom_np(&actions, reader_output + 1);
    // A group of its own keeps Ctrl-C away from it: the caller decides what is cancelled.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);

    pid_t pid = -1;
    const int error = ::posix_spawn(&pid, program.c_str(), &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw_system_error("cannot start " + program, error);
    return pid;
}

std::uint64_t little_endian(std::string_view bytes) {
    std::uint64_t value = 0;
    for (int i = 7; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// Takes frames off the stream of bytes as they become complete.
class Frames {
public:
    void append(const char* bytes, std::size_t size) { buffer_.append(bytes, size); }

    struct Frame {
        char letter;
        std::string contents;
    };
    /// The next complete frame. A damaged length gives nothing for ever, so the run ends as one without a result.
    std::optional<Frame> next() {
        using namespace reader_frame;
        if (buffer_.size() < header_size) return std::nullopt;
        const std::uint64_t length = little_endian(std::string_view(buffer_).substr(1));
        if (length > longest_frame || buffer_.size() - header_size < length) return std::nullopt;
        Frame frame{buffer_.front(), buffer_.substr(header_size, length)};
        buffer_.erase(0, header_size + length);
        return frame;
    }

private:
    std::string buffer_;
};

std::string death(const std::optional<int>& status) {
    if (!status) return "OpenCASCADE ended without a result while reading it";
    if (WIFSIGNALED(*status)) return fmt::format("OpenCASCADE crashed while reading it (signal {})", WTERMSIG(*status));
    return fmt::format("OpenCASCADE gave up while reading it (exit status {})", WEXITSTATUS(*status));
}

void add_places(std::vector<fs::path>& places, const fs::path& program_or_library) {
    const fs::path folder = program_or_library.parent_path();
    if (folder.empty()) return;
    places.push_back(folder / "umbilic_reader");
    places.push_back(folder / "../libexec/umbilic/umbilic_reader");
}

}  // namespace

std::string reader_program() {
    if (const char* chosen = std::getenv("UMBILIC_READER"); chosen && *chosen) return chosen;
    std::vector<fs::path> places;
    std::error_code error;
    add_places(places, fs::read_symlink("/proc/self/exe", error));
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&reader_program), &info) != 0 && info.dli_fname)
        add_places(places, fs::absolute(info.dli_fname, error));
    places.emplace_back(UMBILIC_READER_INSTALLED);
    places.emplace_back(UMBILIC_READER_BUILT);
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error) && ::access(place.c_str(), X_OK) == 0) return place.string();
    throw NumericFailure(
        "the program umbilic_reader, which reads CAD files, was not found; install Umbilic again or set "
        "UMBILIC_READER to its path");
}

std::string run_reader(const std::string& path, const std::vector<std::string>& arguments, const ReaderLimits& limits,
                       const Progress& progress) {
    std::vector<std::string> words = {std::to_string(limits.memory)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw_system_error("cannot open a pipe", errno);
    const FileDescriptor input(ends[0]);
    FileDescriptor output(ends[1]);
    Child child(spawn(reader_program(), words, output.get()));
    output.close();

    const Clock::time_point start = Clock::now();
    Frames frames;
    double fraction = 0.0;
    std::string stage = "reading";
    std::string piece(read_piece, '\0');
    while (true) {
        progress.report(fraction, stage);
        if (std::chrono::duration<double>(Clock::now() - start).count() > limits.seconds)
            throw NumericFailure(
                fmt::format("{}: reading it took more than the time limit of {:g} s; raise the limit or "
                            "split the file",
                            path, limits.seconds));
        pollfd waiting{input.get(), POLLIN, 0};
        const int ready = ::poll(&waiting, 1, static_cast<int>(heartbeat.count()));
        if (ready < 0 && errno != EINTR) throw_system_error("cannot wait for umbilic_reader", errno);
        if (ready <= 0) continue;
        const ssize_t size = ::read(input.get(), piece.data(), piece.size());
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) throw_system_error("cannot read from umbilic_reader", errno);
        if (size == 0) break;
        frames.append(piece.data(), static_cast<std::size_t>(size));
        while (auto frame = frames.next()) {
            switch (frame->letter) {
                case reader_frame::progress:
                    if (frame->contents.size() < 8) continue;
                    fraction = std::clamp(std::bit_cast<double>(little_endian(frame->contents)), 0.0, 1.0);
                    stage = frame->contents.substr(8);
                    continue;
                case reader_frame::result:
                    return std::move(frame->contents);
                case reader_frame::invalid_input:
                    throw InvalidInput(path + ": " + frame->contents);
                case reader_frame::unsupported:
                    throw Unsupported(path + ": " + frame->contents);
                case reader_frame::numeric_failure:
                    throw NumericFailure(path + ": " + frame->contents);
                case reader_frame::out_of_memory:
                    throw NumericFailure(fmt::format(
                        "{}: reading it needs more than the memory limit of {} MiB; raise the limit or split "
                        "the file",
                        path, limits.memory >> 20));
                default:
                    throw InvalidInput(path + ": " + death(std::nullopt) + "; export it again");
            }
        }
    }
    throw InvalidInput(path + ": " + death(child.wait()) +
                       "; the file is malformed — open it in the system that wrote it and export again");
}

}  // namespace umbilic
