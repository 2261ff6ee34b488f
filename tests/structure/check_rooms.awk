# SPDX-License-Identifier: Apache-2.0
# awk -f check_rooms.awk rooms.txt FILE...: checks that the includes of FILEs, paths from the repository's root, are of rooms
# that their room may use (cmake/Rooms.cmake writes rooms.txt). Prints a line for each finding; exit status 1 if there is one.
#   - each file is in a room. The purpose of a room has at most most_purpose (120) characters, because a room that takes
#     longer to describe holds more than one idea. There are at most most_rooms (47)
#   - an include has the path of its file from the root, which is in the same room or in one that this room uses
#   - a room includes something of each room that it uses
#   - no room uses itself by way of others
#   - no object is thread_local outside os_room: MinGW's are destroyed after their memory
#   - only the room os_room (format/os) includes headers of one system, or lists folders by itself: its listFolder lists
#     those on Windows that have long paths
function finding(text) {
    print text
    found = 1
}

function folderOf(path) {
    sub(/\/[^\/]*$/, "", path)
    return path
}

# Visits rooms depth first. A room that is reached again while it is open closes a circle.
function visit(room, path,    names, count, i) {
    if (state[room] == "done") return
    if (state[room] == "open") {
        finding("rooms in a circle: " path room)
        return
    }
    state[room] = "open"
    count = split(uses[room], names, " ")
    for (i = 1; i <= count; i++) visit(names[i], path room " -> ")
    state[room] = "done"
}

BEGIN {
    if (!most_purpose) most_purpose = 120
    if (!most_rooms) most_rooms = 47
    if (!os_room) os_room = "format/os"
    of_posix = "aio|arpa/.*|dirent|dlfcn|fcntl|glob|grp|langinfo|libgen|net/.*|netdb|netinet/.*|poll|pthread|pwd|sched|" \
        "semaphore|signal|spawn|strings|sys/.*|syslog|termios|ucontext|unistd|wordexp"
    of_windows = "windows|io|direct|process|psapi|share|shellapi|shlobj|winsock2"
    system_header = "^[ \t]*#[ \t]*include[ \t]*<(" of_posix "|" of_windows ")\\.h>"
}

FILENAME == ARGV[1] {
    split($0, fields, "|")
    uses[fields[1]] = fields[2]
    rooms[++room_count] = fields[1]
    if (length(fields[3]) > most_purpose) finding(fields[1] ": its purpose takes more than " most_purpose " characters")
    if (room_count == most_rooms + 1) finding("there are more than " most_rooms " rooms")
    next
}

FNR == 1 {
    room = folderOf(FILENAME)
    if (!(room in uses)) finding(FILENAME ": lies in no room")
}

$0 ~ system_header && room != os_room {
    split($0, parts, /[<>]/)
    finding(FILENAME ":" FNR ": <" parts[2] "> is of one system: what needs it belongs in " os_room)
}

/^[ \t]*(static |inline )*thread_local / && room != os_room {
    finding(FILENAME ":" FNR ": is thread_local: on Windows its destructor would run after its memory is freed")
}

/fs::(recursive_)?directory_iterator/ && room != os_room {
    finding(FILENAME ":" FNR ": lists a folder by itself: listFolder of " os_room " does")
}

/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, parts, "\"")
    included = parts[2]
    if (included ~ /\.spv\.h$/) next # compiled shaders
    if (included ~ /^pointrt\/pro/) included = "format/include/" included
    if (included ~ /^pointrt\//) included = "runtime/include/" included
    other = folderOf(included)
    if (other == room) next
    included_by[room, other] = 1
    if (!(other in uses))
        finding(FILENAME ":" FNR ": \"" parts[2] "\" is not a file of a room by its path from the root")
    else if (index(" " uses[room] " ", " " other " ") == 0)
        finding(FILENAME ":" FNR ": " room " may not include " other " (\"" parts[2] "\"): its CMakeLists.txt does not use that room")
}

END {
    for (i = 1; i <= room_count; i++) {
        visit(rooms[i], "")
        count = split(uses[rooms[i]], names, " ")
        for (j = 1; j <= count; j++)
            if (!((rooms[i], names[j]) in included_by)) finding(rooms[i] ": includes nothing of " names[j] ", which it uses")
    }
    exit found
}
