#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""ghost - what is drawn while an element or a rung is dragged: light, dark, with high contrast."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, trace, until  # noqa: E402
from projects import TWO_RUNGS  # noqa: E402
from screen import pixels  # noqa: E402

ROW = 36  # px from the top of a rung with a title to that of its first row
RUNG = ROW + 84 + 9
THEMES = {'light': ({}, (0x1a, 0x5f, 0xb4)),
          'dark': ({'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'}, (0x78, 0xae, 0xed)),
          'contrast': ({'ADW_DEBUG_HIGH_CONTRAST': '1'}, (0x00, 0x3c, 0x8c)),
          'contrast-dark': ({'ADW_DEBUG_HIGH_CONTRAST': '1', 'ADW_DEBUG_COLOR_SCHEME': 'prefer-dark'},
                            (0x99, 0xc9, 0xff))}
COLUMNS = range(6)
RUN = '@print Motor Lamp\nStart=1\nStop=1\nStart=0\n'


def marked(editor, rung_y, accent, row=0):
    """The columns of a row whose upper left corner is marked."""
    x, y, width, _ = editor.place(editor.sheet())
    # The last column is at the right edge.
    left = [x + 61 + 98 * column for column in COLUMNS[:-1]] + [x + width - 24 - 98]
    return [column for column in COLUMNS
            if pixels(left[column] + 2, y + rung_y + ROW + 84 * row + 1, 9, 6).count(accent) >= 5]


def luminance(color):
    """0 to 1, as the eye weighs it."""
    return (0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]) / 255


def inked(editor, x, y, width, height):
    """How many pixels differ clearly from the sheet: the ink of a ghost above an empty place."""
    left, top, wide, high = editor.place(editor.sheet())
    ground = luminance(pixels(left + wide - 30, top + high - 30, 1, 1)[0])
    return sum(abs(luminance(color) - ground) > 0.4 for color in pixels(x, y, width, height))


def states(path):
    """Motor and Lamp after Start, then Stop, then Start released."""
    return [''.join(word[-1] for word in line.split()[-2:]) for line in trace(path, RUN).splitlines()]


def sheets(screen, wanted, *names):
    """Independent editors one after the other: name, editor, colour of its marks. The program saved at last must
    pass the check and have these states."""
    for name in names:
        env, accent = THEMES[name]
        path = new_file(screen, TWO_RUNGS)
        editor = Editor(screen, path, XDG_STATE_HOME=os.path.join(screen.home, name), **env)
        until(lambda editor=editor: len(editor.cells()) == 5, 'the sheet')
        yield name, editor, accent
        editor.save(path)
        check(path)
        assert states(path) == wanted, states(path)
        editor.finish()


def below(editor):
    """A free place that takes no drop."""
    x, y = editor.grid(2 * RUNG + 84 + 160, 2)
    return x, y


def ghosts(screen):
    """a dragged element is visible over an empty place, dragged from the sheet and from the palette"""
    for name, editor, _ in sheets(screen, ['11', '00', '00'], *THEMES):
        x, y = below(editor)
        for kind, start in (('sheet', editor.grid(ROW + 46, 1)), ('palette', editor.tile('closed while FALSE'))):
            editor.drag(start, (x, y), look='ghost-%s-%s' % (kind, name),
                        ready=lambda: 60 < inked(editor, x - 24, y - 14, 48, 28) < 48 * 28 // 2)
            until(lambda: inked(editor, x - 24, y - 14, 48, 28) == 0, 'the ghost to go')


def cells(screen):
    """cells that accept the drop are marked; the one under the pointer has another mark"""
    for name, editor, accent in sheets(screen, ['11', '10', '00'], 'light', 'dark'):
        to = editor.grid(RUNG + ROW + 46, 3)
        editor.drag(editor.grid(ROW + 46, 1), to, look='takes-contact-' + name, ready=lambda: (
            marked(editor, 0, accent) == [0, 1, 2, 3, 4] and marked(editor, RUNG, accent) == [0, 1, 2, 4]))
        until(lambda: not marked(editor, 0, accent), 'the marks to go')
        to = editor.grid(ROW + 46, 2)
        editor.drag(editor.middle(editor.element('Rung 2, COIL')), to, look='takes-coil-' + name, ready=lambda: (
            marked(editor, 0, accent) == [5] and marked(editor, RUNG, accent) == [5]))


def places(screen):
    """a dragged rung is visible, with a line where it would come: at the nearer of two ends"""
    for name, editor, accent in sheets(screen, ['10', '01', '00'], 'dark'):
        x, y, width, _ = editor.place(editor.sheet())
        for at, line in ((RUNG + 30, RUNG), (RUNG + 90, 2 * RUNG), (below(editor)[1] - y, 2 * RUNG), (40, 1)):
            assert 'Lamp' in editor.cells()[-1], editor.cells()
            editor.drag((x + 20, y + RUNG + 50), (x + 20, y + at), look='line-%d-%s' % (at, name), ready=lambda: (
                set(pixels(x + width - 300, y + line, 280, 1)) == {accent} and
                (at < 2 * RUNG or 60 < inked(editor, x + 350, y + at - 30, 120, 60) < 120 * 60 // 2)))
        until(lambda: 'Motor' in editor.cells()[-1], 'the other order')


main([ghosts, cells, places])
