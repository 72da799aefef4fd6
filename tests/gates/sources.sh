# SPDX-License-Identifier: BSD-3-Clause
# Copyright the WideOpen authors
#
# shellcheck shell=sh
#
# Read by the gates with `.`; gives them the list of files.

# source_files ROOT: the files of the project, one per line, relative to ROOT: what git knows and
# what it does not ignore; outside a checkout everything but what a build leaves.
source_files() {
    (
        cd "$1" || exit 2
        if [ -e .git ] && git ls-files >/dev/null 2>&1; then
            git ls-files --cached --others --exclude-standard
        else
            find . \( -path ./.git -o -path ./build -o -path ./demo-out -o -name '*.ofx.bundle' \) \
                -prune -o -type f -print | sed 's|^\./||'
        fi | LC_ALL=C sort -u | while IFS= read -r file; do
            # Removed, but not yet for git.
            [ -f "$file" ] && printf '%s\n' "$file"
        done
        :
    )
}
