#!/bin/sh
# rooms.sh [BUILD] - draws the house: the folders of lib and apps, and which folders each one includes. With a build
# folder it also names the files of one folder that call each other in a circle. It reads the source where it stands,
# or in $ISO_SOURCE: so the same picture is drawn of another state of isoroll.
set -u
objects=${1:+$(realpath "$1")/CMakeFiles/isoroll_objects.dir/lib}
cd "${ISO_SOURCE:-$(dirname "$0")/..}" || exit 1

echo "folder (files): the folders that it includes"
find lib apps -name '*.[ch]' ! -path lib/isoroll.h -exec awk '
    { folder = FILENAME; sub(/^lib\//, "", folder); sub(/\/[^\/]*$/, "", folder) }
    FNR == 1 { files[folder]++ }
    /^#[ ]*include "/ {
        split($0, quoted, "\""); to = quoted[2]
        if (to ~ /^\.\.\//) { parent = folder; while (sub(/^\.\.\//, "", to)) if (!sub(/\/[^\/]*$/, "", parent)) parent = ""
                              if (parent != "") to = parent "/" to }
        if (!sub(/\/[^\/]*$/, "", to)) next
        if (to == "plot") to = "apps/isoroll/plot"
        if (to == folder || folder ~ "/" to "$" || (folder, to) in known) next
        known[folder, to] = 1; list[folder] = list[folder] " " to
    }
    END { for (f in files) print f, files[f] list[f] }' {} + |
    awk 'BEGIN { n = split("base model map method method/taylor exact orbit study io instrument task sweep picture api apps", order, " ")
                 for (i = 1; i <= n; i++) floor[order[i]] = i }
         { top = $1; sub(/\/.*/, "", top)
           m = split($0, word, " "); line = sprintf("  %-22s (%3d):", $1, $2)
           for (i = 3; i <= m; i++) for (j = m; j > i; j--) if (rank(word[j]) < rank(word[j - 1])) { t = word[j]; word[j] = word[j - 1]; word[j - 1] = t }
           for (i = 3; i <= m; i++) line = line " " word[i]
           printf "%s\t%s\n", rank($1), line }
         function rank(f,   top) { top = f; sub(/\/.*/, "", top); return sprintf("%02d %s", floor[top], f) }' |
    sort | cut -f 2-

[ -n "$objects" ] || exit 0
echo "files of one folder that call each other in a circle:"
find "$objects" -name '*.o' -exec nm -A -g {} + | awk -v objects="$objects/" '
    { name = $NF; kind = $(NF - 1); from = $1; sub(/:.*/, "", from); from = substr(from, length(objects) + 1)
      sub(/\.o$/, "", from)
      if (kind == "U") needs[++n] = from " " name; else home[name] = from }
    END {
        for (i = 1; i <= n; i++) {
            split(needs[i], p, " "); a = p[1]; b = home[p[2]]; fa = a; fb = b; sub(/[^\/]*$/, "", fa); sub(/[^\/]*$/, "", fb)
            if (b != "" && a != b && fa == fb) { reach[a, b] = 1; file[a] = fa; file[b] = fa }
        }
        for (k in file) for (i in file) if ((i, k) in reach) for (j in file) if ((k, j) in reach) reach[i, j] = 1
        for (i in file) if (!done[i]) {
            ring = ""
            for (j in file) if ((i, j) in reach && (j, i) in reach) { done[j] = 1; ring = ring "\n" j }
            if (ring != "") { m = split(substr(ring, 2), r, "\n"); line = r[1]
                for (q = 2; q <= m; q++) { sub(/.*\//, "", r[q]); line = line ", " r[q] }
                print "  " line }
        }
    }' | sort
