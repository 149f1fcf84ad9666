// SPDX-License-Identifier: Apache-2.0
// Ids of names, ranks and coverages of Cryptomatte.
#include "film/cryptomatte.h"

#include <catch2/catch.hpp>

using namespace iride;

// Published test vectors of MurmurHash3_x86_32 with seed 0. Fails with the rest read in the other order.
TEST_CASE("murmur3 gives the published hashes", "[unit]") {
    CHECK(murmur3("") == 0);
    CHECK(murmur3("test") == 0xba6bd213);
    CHECK(murmur3("Hello, world!") == 0xc0363e43);
    CHECK(murmur3("The quick brown fox jumps over the lazy dog") == 0x2e4ff723);
    CHECK(murmur3("hello") == 0x248bfa47);
    CHECK(murmur3("abc") == 0xb3dd93fa);
}

TEST_CASE("ids are floats of ordinary size", "[unit]") {
    for (int i = 0; i < 100000; ++i) CHECK((std::isnormal(id_as_float(cryptomatte_id(std::to_string(i))))));
}

// Fails when equal coverages are in another order than that of ids.
TEST_CASE("ranked coverages give back the samples of each id", "[unit]") {
    SamplesById const seen{{7, 100}, {20, 1}, {31, 57}, {40, 57}};
    SamplesById read;
    add_ranked(read, ranked(seen, 253), 253);
    CHECK(read == seen);
    RankedCoverage const channels = ranked(seen, 253);
    CHECK(channels[2] == id_as_float(31));
    CHECK(channels[4] == id_as_float(40));
    CHECK(channels[8] == 0);
}

TEST_CASE("a pixel's objects are ranked by coverage", "[unit]") {
    Cryptomatte matte("CryptoMaterial", {"gold", "say \"x\"", "gold"}, 2, 1);
    for (int object : {1, 0, 2, 1, 0}) matte.add(0, 0, object);
    Image<std::uint32_t> samples(2, 1);
    samples.pixel = {8, 8};
    ExtraLayers layers;
    matte.append_to(layers, samples);
    REQUIRE(layers.channels.size() == 12);
    CHECK(layers.channels[0].first == "CryptoMaterial00.R");
    CHECK(layers.channels[3].first == "CryptoMaterial00.A");
    CHECK(layers.channels[4].first == "CryptoMaterial01.R");
    CHECK(layers.channels[0].second == std::vector<float>{id_as_float(cryptomatte_id("gold")), 0});
    CHECK(layers.channels[1].second == std::vector<float>{3 / 8.0f, 0});
    CHECK(layers.channels[3].second == std::vector<float>{2 / 8.0f, 0});
    CHECK(layers.channels[5].second == std::vector<float>{0, 0});
    REQUIRE(layers.attributes.size() == 4);
    // The specification's own example of a manifest: names to hexadecimal ids.
    CHECK(layers.attributes[3].second.starts_with("{\"gold\":\""));
    CHECK(layers.attributes[3].second.find("\"say \\\"x\\\"\":\"") != std::string::npos);
}
