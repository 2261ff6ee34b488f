// SPDX-License-Identifier: Apache-2.0
// References per splat of a .pro, and what other ways to list splats in the same leaves would cost.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/bench/compare_options.h"
#include "tests/bench/reference_counts.h"

namespace pointrt::test {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const ListCount& list, double splats) {
    return {{"references", list.filled},
            {"per_splat", static_cast<double>(list.filled) / splats},
            {"per_splat_in_all_leaves", static_cast<double>(list.filled + list.empty) / splats}};
}

Json toJson(const std::string& path, const ProFile& file, const ReferenceCounts& counts) {
    const auto splats = static_cast<double>(counts.splats);
    return {{"scene", path},
            {"pruned", (file.info().flags & PRO_FLAG_PRUNED) != 0},
            {"splats", counts.splats},
            {"filled_leaves", counts.filled_leaves},
            {"empty_leaves", counts.empty_leaves},
            {"disc_box", toJson(counts.disc_box, splats)},
            {"slab_box", toJson(counts.slab_box, splats)},
            {"disc", toJson(counts.disc, splats)},
            {"slab", toJson(counts.slab, splats)},
            {"stored", {{"references", counts.stored}, {"per_splat", static_cast<double>(counts.stored) / splats}}}};
}

void print(const Json& report) {
    std::printf("%llu splats, %llu filled and %llu empty leaves; references per splat, in filled leaves and in all:\n",
                report["splats"].get<unsigned long long>(), report["filled_leaves"].get<unsigned long long>(),
                report["empty_leaves"].get<unsigned long long>());
    for (const char* test : {"disc_box", "slab_box", "disc", "slab"})
        std::printf("  %-8s %7.3f %7.3f\n", test, report[test]["per_splat"].get<double>(),
                    report[test]["per_splat_in_all_leaves"].get<double>());
    std::printf("  %-8s %7.3f\n", "stored", report["stored"]["per_splat"].get<double>());
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt::test;
    CLI::App app("Counts the references that listing splats by bounding boxes or exactly would cost.",
                 "count_references");
    std::string scene;
    bool json = false;
    app.add_option("SCENE.pro", scene, "Best baked with --prune off")->required();
    app.add_flag("--json", json, "JSON on standard output");
    return runCompare(app, argc, argv, [&] {
        const pointrt::ProFile file(scene);
        const auto report = toJson(scene, file, countReferences(file));
        if (json)
            std::printf("%s\n", report.dump(2).c_str());
        else
            print(report);
        return 0;
    });
}
