#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# --help fits in 80 columns. Manual pages and completions have exactly the options of --help, and shells offer them.
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"

commands=(pointrt-bake pointrt-info pointrt-view
    "pointrt-rays cast" "pointrt-rays compare" "pointrt-rays contours" "pointrt-rays lidar" "pointrt-rays measure" "pointrt-rays profile"
    "pointrt-rays section" "pointrt-rays sun" "pointrt-rays viewshed" pointrt-rays)

needs() { command -v "$1" >/dev/null || skip "no $1 here"; }

# helpOptions COMMAND WORD...: the long options in --help, one per line, sorted.
helpOptions() { "$@" --help | sed -n 's/^  \(-[a-zA-Z],\)\?\(--[a-z-]*\).*/\2/p' | sort; }

# forEachCommand FUNCTION: FUNCTION COMMAND WORD... prints long options, which must be those of --help.
forEachCommand() {
    local command words
    for command in "${commands[@]}"; do
        read -ra words <<<"$command"
        helpOptions "${words[@]}" >wanted
        [ "$(wc -l <wanted)" -ge 3 ] || fail "$command --help: its options were not found"
        "$1" "${words[@]}" | sort >given
        diff wanted given || fail "$1: $command: not the options of --help"
    done
}

case_help_fits_80_columns() {
    local command words
    for command in "${commands[@]}"; do
        read -ra words <<<"$command"
        "${words[@]}" --help >help.txt
        [ -s help.txt ] || fail "$command --help prints nothing"
        ! grep -nE '.{81}' help.txt || fail "$command --help: lines of more than 80 columns"
    done
}

# manual COMMAND WORD...: the manual page as a terminal shows it. Fails if groff prints a warning.
manual() {
    "$@" --generate man >page.1
    groff -man -Tutf8 -ww -P-cbou page.1 >page.txt 2>warnings || fail "groff: $(cat warnings)"
    [ ! -s warnings ] || fail "$*: $(cat warnings)"
    cat page.txt
}
manualOptions() {
    manual "$@" | sed -n '/^OPTIONS/,/^[A-Z]* *STATUS\|^NOTES/s/^ \{7\}\(-[a-zA-Z], \)\?\(--[a-z-]*\).*/\2/p'
}
case_manual_pages_have_the_options() {
    needs groff
    forEachCommand manualOptions
}
case_manual_pages() {
    needs groff
    manual pointrt-bake >bake.txt
    for heading in NAME SYNOPSIS DESCRIPTION OPTIONS "EXIT STATUS" EXAMPLES "SEE ALSO"; do
        grep -qx "$heading" bake.txt || fail "no section $heading"
    done
    grep -q "pointrt-bake - bakes point scans into a .pro file" bake.txt || fail "whatis says nothing"
    grep -q "pointrt-bake \[OPTION\]\.\.\. SCAN\.\.\. -o FILE" bake.txt || fail "the synopsis is another"
    grep -q "zcat scan.xyz.gz | pointrt-bake - -f -o scan.pro" bake.txt || fail "an example is not as it was"
    manual pointrt-rays | grep "pointrt-rays-viewshed(1)" >/dev/null || fail "pointrt-rays(1) does not name its commands' pages"
}

# bashOffers WORD...: the completions that bash offers for the last word, one per line.
bashOffers() {
    local tool=$1
    "$tool" --generate bash >"$folder/$tool.bash"
    bash --norc -c '
        . "$1"
        shift
        words=("$@") # split as the line editor does: --option=VALUE is three words
        COMP_WORDS=("${words[@]}") COMP_CWORD=$(($# - 1))
        read -ra entry < <(complete -p "$1")
        "${entry[2]}"
        printf "%s\n" "${COMPREPLY[@]}"' bash "$folder/$tool.bash" "$@" | sort -u
}
bashOptions() { bashOffers "$@" --; }
case_bash_completes_the_options() { forEachCommand bashOptions; }

zshOptions() { zshOffers "$*" --; }
# zshOffers LINE WORD: the completions that zsh offers for WORD at the end of LINE.
zshOffers() {
    mkdir -p "$folder/zsh"
    "${1%% *}" --generate zsh >"$folder/zsh/_${1%% *}"
    zsh -f "$suite_dir/completions.zsh" "$folder/zsh" "$1 $2" | sed '/^$/d' | sort -u
}
case_zsh_completes_the_options() {
    needs zsh
    forEachCommand zshOptions
}

# fishOffers LINE WORD: the completions that fish offers for WORD at the end of LINE. fish 4 also prints options that contain
# the letters of WORD in order.
fishOffers() {
    "${1%% *}" --generate fish >"$folder/tool.fish"
    HOME=$folder fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$folder/tool.fish" "$1 $2" | cut -f 1 |
        sort -u | if [ "${2#-}" = "$2" ]; then cat; else sed -n "/^$2/p"; fi
}
fishOptions() { fishOffers "$*" -- | sed -n '/^--/p'; }
case_fish_completes_the_options() {
    needs fish
    forEachCommand fishOptions
}

bashLine() {
    local words
    read -ra words <<<"$1"
    bashOffers "${words[@]}" "$2"
}

# expectOffers WANTED FUNCTION LINE WORD: FUNCTION LINE WORD, in the folder files/, must print WANTED (sorted, folders
# without their slash).
expectOffers() {
    local wanted=$1 given
    shift
    given=$(cd files && "$@" | sed 's,/$,,' | tr '\n' ' ')
    [ "${given% }" = "$wanted" ] || fail "$*: '$given' is offered, not '$wanted'"
}
# theSameIn FUNCTION: checks the completions that all shells must offer. FUNCTION LINE WORD prints those of a shell.
theSameIn() {
    mkdir -p files/tiles files/more.proset
    touch files/{a.pro,b.ply,c.LAZ,d.json,e.toml,f.png,g.exr}
    expectOffers "auto off on" "$1" "pointrt-view a.pro --denoise" ""
    expectOffers "ambient depth normal path phong whitted" "$1" "pointrt-view a.pro --integrator" ""
    expectOffers "--color-by --color-map --color-range" "$1" "pointrt-view a.pro" --color-
    expectOffers "turbo" "$1" "pointrt-view a.pro --color-map" tu
    expectOffers "-x -y -z auto x y z" "$1" "pointrt-bake b.ply --up" ""
    expectOffers "f.png g.exr more.proset tiles" "$1" "pointrt-view a.pro -o" ""
    expectOffers "a.pro b.ply c.LAZ e.toml more.proset tiles" "$1" "pointrt-view" ""
    expectOffers "b.ply c.LAZ more.proset tiles" "$1" "pointrt-bake" ""
    expectOffers "" "$1" "pointrt-view a.pro --spp" ""
    expectOffers "cast compare contours lidar measure profile section sun viewshed" "$1" "pointrt-rays" ""
    expectOffers "--sensor" "$1" "pointrt-rays lidar" --sen
    expectOffers "e.toml more.proset tiles" "$1" "pointrt-rays lidar --sensor" ""
}
case_bash_offers() {
    theSameIn bashLine
    expectOffers "path phong" bashLine "pointrt-view a.pro --integrator =" p
    expectOffers "auto off on" bashLine "pointrt-view a.pro --denoise" =
}
case_zsh_offers() {
    needs zsh
    theSameIn zshOffers
}
case_fish_offers() {
    needs fish
    theSameIn fishOffers
}

runCase "$@"
