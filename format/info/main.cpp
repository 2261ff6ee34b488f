// SPDX-License-Identifier: Apache-2.0
// pointrt-info: summarizes, verifies and exports .pro files and tile sets.

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/base/require_pro.h"
#include "format/base/run_tool.h"
#include "format/base/same_file.h"
#include "format/cli/command_line.h"
#include "format/info/export_gaussians.h"
#include "format/info/export_points.h"
#include "format/info/export_spz.h"
#include "format/info/print.h"
#include "format/info/set_report.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"
#include "format/pointio/metadata.h"
#include "format/pointio/point_sink.h"
#include "format/set/tile_set.h"

namespace {

using namespace pointrt;
using Json = nlohmann::ordered_json;

struct Options {
    std::string input, export_path;
    bool json = false, verify = false, force = false, quiet = false, scalar_names = false;
};

constexpr const char* kExamples = "  pointrt-info scan.pro\n"
                                  "  pointrt-info scan.pro --verify && echo valid\n"
                                  "  pointrt-info scan.pro --json | jq .splats\n"
                                  "  pointrt-info scan.pro --export splats.ply\n"
                                  "  pointrt-info scan.pro --export points.laz\n";

void addOptions(CommandLine& app, Options& options) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.add_option("FILE", options.input, "A .pro file or the folder of a tile set (NAME.proset)")
        ->required()
        ->type_name("");
    completes(app, "FILE", ".pro .proset");
    app.add_flag("--json", options.json, "Print JSON instead of text");
    app.add_flag("--verify", options.verify, "Verify all checksums and contents; exit with 1 on findings");
    app.add_option("--export", options.export_path,
                   "Write the splats to a new .ply, .pcd, .las, .laz or .e57 file, in input order or tile by tile "
                   "(Gaussians: as a .ply of 3D Gaussian splatting, or as .spz); - is PLY on standard output")
        ->type_name("FILE");
    completes(app, "--export", ".ply .pcd .las .laz .e57 .spz");
    app.add_flag("--scalar-names", options.scalar_names,
                 "Start the names of attributes in an exported PLY with scalar_, as CloudCompare does");
    app.add_flag("-f,--force", options.force, "Let --export overwrite an existing file");
    app.add_flag("-q,--quiet", options.quiet, "Print only errors and findings");
    addCommonOptions(app, POINTRT_VERSION, "FILE cannot be read or is malformed", kExamples);
}

void checkOptions(const Options& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    const std::string& path = options.export_path;
    if (options.input == "-") usage("-: a .pro is memory-mapped, so it must be a file");
    if (path.empty() && options.force) usage("--force needs --export");
    if (options.scalar_names && path != "-" && !path.ends_with(".ply")) usage("--scalar-names needs --export to PLY");
    if (path.empty()) return;
    if (options.json || options.verify)
        usage(std::string("--export and ") + (options.json ? "--json" : "--verify") + " cannot be combined");
    if (path == "-" && isTerminal(kStandardOutput))
        usage("--export -: standard output is a terminal; redirect the splats to a file or a pipe");
    if (path != "-" && isSameFile(options.input, path)) usage(path + ": is the input");
    const auto has = [&](const char* suffix) { return path.ends_with(suffix); };
    if (path != "-" && !has(".ply") && !has(".pcd") && !has(".las") && !has(".laz") && !has(".e57") && !has(".spz"))
        usage(path + ": --export writes .ply, .pcd, .las, .laz, .e57 or .spz");
}

struct FindingList {
    std::vector<pro_message> findings;

    static void add(const pro_message* finding, void* user) {
        static_cast<FindingList*>(user)->findings.push_back(*finding);
    }
};

void printFindings(const Options& options, const FindingList& list) {
    if (options.json) {
        Json json = {{"file", options.input}, {"findings", Json::array()}};
        for (const pro_message& finding : list.findings)
            json["findings"].push_back({{"number", finding.finding}, {"text", finding.text}});
        std::printf("%s\n", dumpJson(json, false).c_str());
        return;
    }
    const std::string shown = printable(options.input, std::string::npos);
    for (const pro_message& finding : list.findings)
        std::printf("%s: finding %04u: %s\n", shown.c_str(), finding.finding,
                    printable(finding.text, std::string::npos).c_str());
    if (list.findings.empty() && !options.quiet) std::printf("%s: no findings\n", shown.c_str());
}

int verify(const Options& options) {
    FindingList list;
    std::size_t count = 0;
    pro_message message{};
    checkPro(pro_verify(options.input.c_str(), FindingList::add, &list, &count, &message), options.input, message);
    printFindings(options, list);
    if (count == 0) return 0;
    throw Error(ExitCode::kBadInput,
                options.input + ": " + std::to_string(count) + (count == 1 ? " finding" : " findings"));
}

int exportSplats(const Options& options, const ExportSource& source) {
    const std::string& path = options.export_path;
    const bool is_spz = path.ends_with(".spz");
    if (is_spz && !source.has_gaussians)
        throw Error(ExitCode::kBadUsage, options.input + ": holds no Gaussians, and SPZ holds nothing else");
    if (is_spz)
        exportSpz(source, path, options.force);
    else if (source.has_gaussians && pointFormat(path) == PointFormat::kPly)
        exportGaussians(source, path, options.force);
    else
        exportPoints(source, path, options.force, options.scalar_names);
    return 0;
}

int exportFile(const Options& options) {
    const ProFile file(options.input);
    return exportSplats(options, exportSource(file));
}

int print(const Options& options) {
    const ProFile file(options.input);
    const Summary summary = summarize(file);
    const std::string text = options.json ? summaryJson(summary, file) : summaryText(options.input, summary, file);
    std::fwrite(text.data(), 1, text.size(), stdout);
    return 0;
}

int runSet(const Options& options) {
    if (!options.export_path.empty())
        return exportSplats(options, exportSource(readTileSet(options.input), options.input));
    return options.verify ? verifySet(options.input, options.json, options.quiet)
                          : printSet(options.input, options.json);
}

int runOptions(const Options& options) {
    checkOptions(options);
    if (isTileSet(options.input)) return runSet(options);
    if (!options.verify) requirePro(options.input);
    return options.verify ? verify(options) : options.export_path.empty() ? print(options) : exportFile(options);
}

} // namespace

int main(int argc, char** argv) {
    return runTool("pointrt-info", [&] {
        CommandLine app("Summarizes, verifies and exports .pro files and tile sets.", "pointrt-info");
        Options options;
        addOptions(app, options);
        if (const auto done = parseCommandLine(app, argc, argv,
                                               {{".ply", "--export"},
                                                {".pcd", "--export"},
                                                {".las", "--export"},
                                                {".laz", "--export"},
                                                {".e57", "--export"}}))
            return *done;
        const int code = runOptions(options);
        if (std::fflush(stdout) != 0) throw Error(ExitCode::kCannotWrite, "standard output: cannot write");
        return code;
    });
}
