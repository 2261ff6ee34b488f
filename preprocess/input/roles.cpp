// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/roles.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>

namespace pointrt {
namespace {

struct Alias {
    std::string_view name;
    Role role;
};

constexpr Alias kAliases[] = {
    {"x", kX},
    {"y", kY},
    {"z", kZ},
    {"nx", kNormalX},
    {"ny", kNormalY},
    {"nz", kNormalZ},
    {"normal_x", kNormalX},
    {"normal_y", kNormalY},
    {"normal_z", kNormalZ},
    {"normalx", kNormalX},
    {"normaly", kNormalY},
    {"normalz", kNormalZ},
    {"red", kRed},
    {"green", kGreen},
    {"blue", kBlue},
    {"r", kRed},
    {"g", kGreen},
    {"b", kBlue},
    {"rf", kRed}, // shares of 1, as CloudCompare writes them
    {"gf", kGreen},
    {"bf", kBlue},
    {"diffuse_red", kRed},
    {"diffuse_green", kGreen},
    {"diffuse_blue", kBlue},
};

bool holdsAll(std::span<const Role> roles, std::initializer_list<Role> wanted) {
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); });
}

void drop(std::span<Role> roles, Role first, Role last) {
    for (Role& role : roles)
        if (role >= first && role <= last) role = kIgnored;
}

} // namespace

Role roleOfName(std::string_view name) {
    std::string lower(name);
    for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    for (const Alias& alias : kAliases)
        if (alias.name == lower) return alias.role;
    return kIgnored;
}

void settleRoles(std::span<Role> roles) {
    bool seen[kRoleCount] = {};
    for (Role& role : roles) {
        if (role == kIgnored) continue;
        if (seen[role])
            role = kIgnored;
        else
            seen[role] = true;
    }
    if (!hasNormals(roles)) drop(roles, kNormalX, kNormalZ);
    if (!hasColors(roles)) drop(roles, kRed, kBlue);
}

bool hasPositions(std::span<const Role> roles) { return holdsAll(roles, {kX, kY, kZ}); }
bool hasNormals(std::span<const Role> roles) { return holdsAll(roles, {kNormalX, kNormalY, kNormalZ}); }
bool hasColors(std::span<const Role> roles) { return holdsAll(roles, {kRed, kGreen, kBlue}); }

} // namespace pointrt
