"""CREDITS.md: who made the furniture that the homes show, and under which licence."""
ADDRESSES = {
    "CC-BY-3.0": "https://creativecommons.org/licenses/by/3.0/",
    "CC-BY-3.0-US": "https://creativecommons.org/licenses/by/3.0/us/",
    "CC0": "https://creativecommons.org/publicdomain/zero/1.0/",
}


def text(homes):
    used = {}
    for home in homes:
        for key, piece in home.used_pieces().items():
            used.setdefault(key, (piece, []))[1].append(home.name)
    lines = ["# Credits of the sample homes", "",
             "The homes are our own drawing, and so are the surfaces, pictures and rugs. The furniture comes from Debian's package",
             "`sweethome3d-furniture` (models gathered for Sweet Home 3D, https://www.sweethome3d.com), unchanged but for size and colour; each",
             "piece is by the author named here, under the licence named here.", "",
             *[f"- {name}: {address}" for name, address in ADDRESSES.items()], "",
             "| piece | catalogue id | author | licence | homes |", "|---|---|---|---|---|"]
    for key in sorted(used):
        piece, names = used[key]
        if piece.creator != "roomlight":
            lines.append(f"| {piece.name} | `{piece.catalogue_id}` | {piece.creator} | {piece.licence} | {', '.join(names)} |")
    return "\n".join(lines) + "\n"
