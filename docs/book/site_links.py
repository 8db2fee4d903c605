# SPDX-License-Identifier: LGPL-3.0-or-later
"""The links of a folder of HTML pages lead to files and anchors that exist, and nothing is loaded from the network."""
import html.parser
import pathlib
import re
import urllib.parse

LOADED = {"script": "src", "img": "src", "link": "href"}


class _Page(html.parser.HTMLParser):
    """The links and anchors of one page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors.update(given[name] for name in ("id", "name") if given.get(name))
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag in LOADED and given.get(LOADED[tag]) and given.get("rel") != "canonical":
            self.loaded.append(given[LOADED[tag]])


def _pages(site):
    """Returns the pages of the book by their paths; those of the API are checked as targets only."""
    return {path: _Page(path.read_text(encoding="utf-8", errors="replace")) for path in site.rglob("*.html")
            if path.relative_to(site).parts[0] not in ("api", "files")}


def _fault(site, pages, path, link):
    url = urllib.parse.urlsplit(link)
    if url.scheme or url.netloc:
        return None
    file = (path.parent / urllib.parse.unquote(url.path)).resolve() if url.path else path
    if file.is_dir():
        file /= "index.html"
    if not file.is_relative_to(site) or not file.exists():
        return "there is no such file"
    if url.fragment and file in pages and urllib.parse.unquote(url.fragment) not in pages[file].anchors:
        return "there is no such anchor"
    return None


def faults(site):
    """Returns what is wrong, a line for each link."""
    site = pathlib.Path(site).resolve()
    pages = _pages(site)
    found = [] if pages else [f"{site}: no pages"]
    for path, page in sorted(pages.items()):
        name = path.relative_to(site)
        if name.name != "404.html":  # its links begin at the top of a server
            wrong = ((link, _fault(site, pages, path, link)) for link in [*page.links, *page.loaded])
            found += [f"{name}: link to {link}: {fault}" for link, fault in wrong if fault]
        found += [f"{name}: loads {link} from the network" for link in page.loaded if re.match(r"(https?:)?//", link)]
    return found
