// SPDX-License-Identifier: Apache-2.0
// A file is written whole or not at all, and what cannot be written is known before.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <thread>

#include "base/atomic_file.h"
#include "support/files.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string refusal(fs::path const& target) {
    try {
        check_writable(target);
    } catch (InputError const& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

// Fails without the rename, and when the target itself is written.
TEST_CASE("a committed file is there whole, and nothing else", "[unit]") {
    test::TemporaryFolder const folder;
    fs::path const target = folder.write("a.txt", "old");
    {
        AtomicFile file(target);
        CHECK(file.temporary().parent_path() == folder.path());  // a rename does not cross file systems
        CHECK(file.temporary().extension() == ".txt");
        std::ofstream(file.temporary()) << "new";
        CHECK(test::content(target) == "old");
        file.commit();
    }
    CHECK(test::content(target) == "new");
    CHECK(test::file_count(folder.path()) == 1);
    write_file(folder.path() / "b.txt", std::string("a\0b", 3));
    CHECK(test::content(folder.path() / "b.txt").size() == 3);
}

// Fails when the target itself is written.
TEST_CASE("without commit the target is untouched and no temporary file stays", "[unit]") {
    test::TemporaryFolder const folder;
    fs::path const target = folder.write("a.txt", "old");
    try {
        AtomicFile const file(target);
        std::ofstream(file.temporary()) << "half";
        throw std::runtime_error("a writer failed");
    } catch (std::runtime_error const&) {
    }
    CHECK(test::content(target) == "old");
    CHECK(test::file_count(folder.path()) == 1);
}

TEST_CASE("a temporary file that vanished is an error and leaves the target alone", "[input]") {
    test::TemporaryFolder const folder;
    fs::path const target = folder.write("a.txt", "old");
    AtomicFile file(target);
    fs::remove(file.temporary());
    CHECK_THROWS_WITH(file.commit(), Contains("cannot be written") && Contains("No such file"));
    CHECK(test::content(target) == "old");
}

// Fails without the rename.
TEST_CASE("two writers of one target do not mix", "[unit]") {
    test::TemporaryFolder const folder;
    fs::path const target = folder.path() / "a.txt";
    auto const writer = [&](char letter) {
        for (int i = 0; i < 50; ++i) write_file(target, std::string(10000, letter));
    };
    std::thread a(writer, 'a'), b(writer, 'b');
    a.join();
    b.join();
    std::string const text = test::content(target);
    CHECK(text == std::string(10000, text.at(0)));
    CHECK(test::file_count(folder.path()) == 1);
}

TEST_CASE("a place where nothing can be written is refused with its reason", "[input]") {
    test::TemporaryFolder const folder;
    fs::path const in = folder.path();
    fs::path const file = folder.write("file", "x");
    CHECK_THAT(refusal(in / "none" / "a.exr"),
               Contains(fmt::format("the folder '{}' does not exist", (in / "none").string())));
    CHECK_THAT(refusal(file / "a.exr"), Contains(fmt::format("'{}' is not a folder", file.string())));
    CHECK_THAT(refusal(in), Contains("cannot be written: it is a folder"));
    CHECK_THAT(refusal(in / ""), Contains("it names no file"));
    CHECK_THAT(refusal("/dev/null"), Contains("it is not a regular file"));          // root could rename onto it
    CHECK_THAT(refusal("/proc/a.exr"), Contains("/proc/a.exr: cannot be written"));  // even root fails to create one
    CHECK_THAT(refusal(in / std::string(300, 'x')), Contains("File name too long"));
    CHECK(refusal(in / "a.exr") == "no error");
    CHECK(refusal(file) == "no error");
    CHECK(test::content(file) == "x");
    CHECK(test::file_count(in) == 1);
}

TEST_CASE("a folder without permission to write is refused", "[input]") {
    test::TemporaryFolder const folder;
    fs::path const closed = folder.path() / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    std::string const message = refusal(closed / "a.exr");
    fs::permissions(closed, fs::perms::owner_all);
    if (::geteuid() == 0)
        CHECK(message == "no error");  // root is not bound by permissions
    else
        CHECK_THAT(message, Contains("is not writable: Permission denied"));
    CHECK(test::file_count(closed) == 0);
}
