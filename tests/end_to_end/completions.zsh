# SPDX-License-Identifier: Apache-2.0
# completions.zsh FOLDER LINE: what zsh offers when tab is pressed at the end of LINE, one a line, with the completions
# of FOLDER. Completing wants a terminal, and so there is one, in which compadd prints what it is given.
zmodload zsh/zpty
zpty terminal "zsh -f -i"
start='
PROMPT= RPROMPT=; unsetopt zle_bracketed_paste 2>/dev/null; stty -echo columns 1000
fpath=('"${(q)1}"' $fpath); autoload -U compinit; compinit -u -D
zstyle ":completion:*" list-prompt ""; LISTMAX=0; setopt no_list_beep no_beep
compadd() {
    if [[ " ${(j: :)@[1,(i)(-|--)]} " == *" -"[OAD]" "* ]]; then builtin compadd "$@"; return; fi
    local -a hits; builtin compadd -A hits "$@"; (( $#hits )) && print -rl -- "<"${^hits}">"
    builtin compadd "$@"
}
offer() { print "<<<"; _main_complete "$@"; compstate[insert]= compstate[list]=; print ">>>" }
zle -C offer complete-word offer; bindkey "^T" offer
'
for line in ${(f)start}; do zpty -w terminal $line; done
zpty -w terminal 'print READ""Y'
zpty -r terminal said '*READY*'
zpty -w -n terminal "$2"$'\x14'
zpty -r terminal said '*>>>*'
print -r -- ${said##*<<<} | tr -d '\r' | sed -n 's/^.*<\(.*\)>$/\1/p'
