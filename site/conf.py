"""Sphinx configuration of the site; `site/build.py` gathers the pages and calls it."""

project = "undulator"
author = "The undulator developers"
extensions = ["myst_parser"]  # CommonMark, as GitHub reads the same pages
myst_heading_anchors = 4  # links to headings, spelt as GitHub spells them
html_theme = "furo"  # no font or script from elsewhere
html_title = "undulator"
html_favicon = "static/icon.svg"
html_css_files = ["site.css"]
suppress_warnings = ["toc.not_included"]  # code that a page links to; links are checked after
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
pygments_style = "friendly"
