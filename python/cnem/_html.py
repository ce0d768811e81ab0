"""Small pages for notebooks."""

import base64
import html


def table(rows):
    cells = "".join(
        f'<tr><td style="text-align:left">{html.escape(str(label))}</td>'
        f'<td style="text-align:left">{html.escape(str(text))}</td></tr>'
        for label, text in rows
    )
    return f"<table>{cells}</table>"


def picture(run):
    """An image of the cells as they are; nothing in space."""
    if run.dimensions != 2:
        return ""
    png = base64.b64encode(run.picture(width=640)).decode()
    return f'<img alt="cells of {html.escape(run.name)}" style="max-width:100%" src="data:image/png;base64,{png}">'
