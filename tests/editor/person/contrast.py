#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""contrast - every text in the window against what is behind it, measured on the screen.

WCAG 2.1, 1.4.3: 4.5 : 1. Texts of what cannot be used are exempt. Two pixels to a point, so
that a letter has pixels which are nothing but ink.
"""
import collections
import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import EXTENTS, ROLES, ROOT, Editor, main, sh, until  # noqa: E402

SCALE = 2
SELECTED, SENSITIVE = 23, 24  # states, as AtspiStateType counts


def luminance(color):
    parts = [each / 255 for each in color]
    red, green, blue = [each / 12.92 if each <= 0.03928 else ((each + 0.055) / 1.055) ** 2.4 for each in parts]
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def ratio(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


class Picture:
    """What is on the screen."""

    def __init__(self):
        data = subprocess.run(['import', '-window', 'root', '-depth', '8', 'ppm:-'], capture_output=True,
                              check=True).stdout
        size, _, self.pixels = data[3:].split(b'\n', 2)
        self.width, self.height = map(int, size.split())

    def colors(self, x, y, width, height):
        """Of a place: color -> how many pixels."""
        count = collections.Counter()
        for line in range(max(y, 0), min(y + height, self.height)):
            start = 3 * (line * self.width + max(x, 0))
            row = self.pixels[start:start + 3 * (min(x + width, self.width) - max(x, 0))]
            count.update(zip(row[0::3], row[1::3], row[2::3]))
        return count


def ink(colors):
    """The ratio of what is behind, the most of it, to what differs most from it."""
    if len(colors) < 2:
        return None
    behind = colors.most_common(1)[0][0]
    return max(ratio(color, behind) for color, count in colors.items() if count >= 3)


def faint(editor, where, known):
    """Texts with less than 4.5 : 1, each as a line, but for those that are @known, as path and name."""
    about = sh('xwininfo', '-id', editor.window)
    left, top, width, height = [int(each.split()[-1]) for each in about.splitlines()
                                if each.strip().startswith(('Absolute', 'Width', 'Height'))]
    nodes = [node for node in editor.walk() if node.role == ROLES['frame'] or (
        node.role in (ROLES['label'], ROLES['text']) and node.name.strip() and node.states >> SENSITIVE & 1)]
    texts = editor.ask([(node.path, 'Text', 'GetText', 'ii', 0, -1) for node in nodes])
    nodes = [node for node, text in zip(nodes, texts) if node.role != ROLES['text'] or text and text[0].strip()]
    boxes = editor.ask([(node.path, *EXTENTS) for node in nodes])
    frame = next(box[0] for node, box in zip(nodes, boxes) if node.role == ROLES['frame'])
    picture, told = Picture(), []
    for node, box in zip(nodes, boxes):
        if not box or node.role == ROLES['frame'] or min(box[0][2:]) < 2 or (node.path, node.name) in known:
            continue
        x, y, w, h = [SCALE * each for each in box[0]]
        value = ink(picture.colors(left + width // 2 - frame[2] + x, top + height // 2 - frame[3] + y, w, h))
        if value is not None:
            known.add((node.path, node.name))
        if value is not None and value < 4.5:
            told.append('%s: "%s" is %.2f : 1' % (where, node.name, value))
    return told


def look(screen, theme):
    """The window with a program, simulated, and each panel below the sheet."""
    editor = Editor(screen, os.path.join(ROOT, 'ladders', 'garage-door.rung'), GDK_SCALE=str(SCALE),
                    ADW_DEBUG_COLOR_SCHEME='prefer-dark' if theme == 'dark' else 'prefer-light')
    editor.to_sheet()
    known = set()
    told = faint(editor, 'the sheet', known)
    editor.shot('contrast-' + theme)
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    told += faint(editor, 'simulating', known)
    editor.keys('ctrl+alt+w')
    editor.find('StopOk, New value')
    told += faint(editor, 'Status chart', known)
    editor.keys('ctrl+F5')
    editor.find('passed')
    told += faint(editor, 'Scenarios', known)
    for tab in 'Cross reference', 'Status chart', 'Timing chart', 'Scenarios', 'Instruction list', 'Log', 'Board':
        editor.press(editor.find(tab, 'page tab'))
        until(lambda: editor.find(tab, 'page tab').states >> SELECTED & 1, 'the tab ' + tab)
        told += faint(editor, tab, known)
        editor.shot('contrast-%s-%s' % (theme, tab.split()[0]))
    editor.keys('ctrl+alt+s')
    editor.find('Add a symbol', 'push button')
    told += faint(editor, 'the symbols', known)
    editor.shot('contrast-%s-symbols' % theme)
    assert not told, '\n'.join(told)
    assert len(known) >= 100, 'only %d texts were seen' % len(known)


def light(screen):
    """light: no text is fainter than 4.5 : 1, in the window, while it simulates, in each panel"""
    look(screen, 'light')


def dark(screen):
    """dark: the same"""
    look(screen, 'dark')


light.size = dark.size = '2880x1800x24'
main([light, dark])
