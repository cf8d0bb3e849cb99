#!/usr/bin/env bash
# Installs Debian's Coq, LaTeX and Chromium where they are missing and this is possible (root, apt-get); otherwise says what is left out.
set -euo pipefail

have_coq() {
    local lib
    command -v coqc >/dev/null || return 1
    for lib in Coquelicot Interval mathcomp/algebra; do
        [ -d "$(coqc -where)/user-contrib/$lib" ] || return 1
    done
}

have_latex() {
    local style
    command -v pdflatex pdftoppm >/dev/null && command -v kpsewhich >/dev/null || return 1
    for style in pgfplots siunitx lmodern microtype booktabs; do
        kpsewhich "$style.sty" >/dev/null || return 1
    done
}

packages=()
have_coq || packages+=(coq libcoq-coquelicot libcoq-interval libcoq-mathcomp-algebra)
have_latex || packages+=(texlive-latex-recommended texlive-latex-extra texlive-pictures texlive-fonts-recommended
    texlive-science lmodern poppler-utils)
command -v chromium >/dev/null || packages+=(chromium)
[ ${#packages[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
    echo "installing Debian's ${packages[*]}"
    export DEBIAN_FRONTEND=noninteractive
    log=$(mktemp)
    apt-get update -qq >"$log" 2>&1 || true
    apt-get install -y -qq --no-install-recommends "${packages[@]}" >>"$log" 2>&1 || tail -n 5 "$log" >&2
    rm -f "$log"
fi
have_coq || echo "left out: proofs (coq, coquelicot, interval or mathcomp is missing)"
have_latex || echo "left out: PDF (a LaTeX with pgfplots and siunitx, or pdftoppm, is missing)"
command -v chromium >/dev/null || echo "left out: the width of an HTML report on a phone (chromium is missing)"
