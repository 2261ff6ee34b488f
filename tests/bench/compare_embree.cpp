// SPDX-License-Identifier: Apache-2.0
// Compares our first hits on flat discs with Embree's, for random and grazing rays from outside. Every difference is
// explained by recomputing it in double, or counted as unexplained.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/bench/compare_options.h"
#include "tests/support/first_hit_check.h"

namespace pointrt::test {

namespace {

using Json = nlohmann::ordered_json;

/// Number of unexplained rays to print.
constexpr std::size_t kExamples = 20;

struct Comparison {
    std::vector<Ray> rays;
    std::vector<CastHit> ours;
    std::vector<EmbreeHit> embrees;
    FirstHitCheck check;
};

Json toJson(Vec3 v) { return {v.x, v.y, v.z}; }

Json splatJson(std::uint32_t splat) { return splat == kNoSplat ? Json(nullptr) : Json(splat); }

Json example(const Comparison& comparison, std::size_t i) {
    return {{"origin", toJson(comparison.rays[i].origin)},
            {"direction", toJson(comparison.rays[i].direction)},
            {"our_splat", splatJson(comparison.ours[i].splat)},
            {"our_t", comparison.ours[i].t_flat},
            {"embree_splat", splatJson(comparison.embrees[i].splat)},
            {"embree_t", comparison.embrees[i].t}};
}

Json toJson(const Comparison& comparison) {
    const FirstHitCheck& check = comparison.check;
    Json examples = Json::array();
    for (std::size_t k = 0; k < std::min(kExamples, check.unexplained.size()); ++k)
        examples.push_back(example(comparison, check.unexplained[k]));
    return {{"rays", check.rays},
            {"hits", check.hits},
            {"agree", check.count(Verdict::kAgree)},
            {"agree_share", check.agreement()},
            {"rim", check.count(Verdict::kRim)},
            {"tie", check.count(Verdict::kTie)},
            {"rounding", check.count(Verdict::kRounding)},
            {"double_is_ours", check.double_is_ours},
            {"unexplained", check.unexplained.size()},
            {"unexplained_ours", check.count(Verdict::kWeMiss)},
            {"unexplained_embree", check.count(Verdict::kEmbreeMisses)},
            {"unexplained_examples", examples}};
}

void print(const char* kind, const FirstHitCheck& check) {
    std::printf("%s: %zu rays, %zu hits, %.5f%% agree; differ at a rim %zu, in a tie %zu, rounding %zu "
                "(double is on our side in %zu), unexplained %zu (ours %zu, Embree's %zu)\n",
                kind, check.rays, check.hits, 100 * check.agreement(), check.count(Verdict::kRim),
                check.count(Verdict::kTie), check.count(Verdict::kRounding), check.double_is_ours,
                check.unexplained.size(), check.count(Verdict::kWeMiss), check.count(Verdict::kEmbreeMisses));
}

/// Returns 1 if a difference is unexplained.
int compare(const std::string& path, const CompareOptions& options) {
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    const EmbreeDiscs embree(splats);
    RayCaster caster(path);
    const NearRounding rounding = nearRounding(splats, caster.cellEdge());
    const auto run = [&](std::vector<Ray> rays) {
        Comparison result{std::move(rays), {}, {}, {}};
        result.ours = caster.cast(result.rays);
        result.embrees = embree.cast(result.rays);
        result.check = checkFirstHits(splats, rounding, result.rays, result.ours, result.embrees);
        return result;
    };
    const Comparison random = run(randomRays(boundingSphere(splats), options.rays, options.seed));
    const Comparison grazing = run(grazingRays(splats, options.rays, options.seed));
    if (options.json) {
        const Json report = {{"scene", path},
                             {"splats", splats.size()},
                             {"seed", options.seed},
                             {"random", toJson(random)},
                             {"grazing", toJson(grazing)}};
        std::printf("%s\n", report.dump(2).c_str());
    } else {
        print("random", random.check);
        print("grazing", grazing.check);
    }
    return random.check.unexplained.empty() && grazing.check.unexplained.empty() ? 0 : 1;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    CLI::App app("Compares first hits on flat discs with Embree's.", "compare_embree");
    std::string scene;
    pointrt::test::CompareOptions options;
    app.add_option("SCENE.pro", scene, "Best baked with --prune off")->required();
    pointrt::test::addCompareOptions(app, options);
    return pointrt::test::runCompare(app, argc, argv, [&] { return pointrt::test::compare(scene, options); });
}
