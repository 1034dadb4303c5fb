#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""contrast - the contrast of each text in the window, measured on the screen.

WCAG 2.1, 1.4.3: 4.5 : 1; texts of insensitive widgets are exempt. Two pixels to a point, so that letters have
pixels of pure ink.
"""
import collections
import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import EXTENTS, ROLES, ROOT, Chinese, Editor, main, sh, until, urge  # noqa: E402

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
    """A screenshot."""

    def __init__(self):
        data = subprocess.run(['import', '-window', 'root', '-depth', '8', 'ppm:-'], capture_output=True,
                              check=True).stdout
        size, _, self.pixels = data[3:].split(b'\n', 2)
        self.width, self.height = map(int, size.split())

    def colors(self, x, y, width, height):
        """The colours of an area: colour -> number of pixels."""
        count = collections.Counter()
        for line in range(max(y, 0), min(y + height, self.height)):
            start = 3 * (line * self.width + max(x, 0))
            row = self.pixels[start:start + 3 * (min(x + width, self.width) - max(x, 0))]
            count.update(zip(row[0::3], row[1::3], row[2::3]))
        return count


def ink(colors):
    """Contrast ratio between the most frequent colour and the one that differs most from it."""
    if len(colors) < 2:
        return None
    behind = colors.most_common(1)[0][0]
    return max(ratio(color, behind) for color, count in colors.items() if count >= 3)


def whole(node, nodes, boxes):
    """Is the widget wholly visible? If it is scrolled away, another widget stands at its place."""
    x, y, width, height = boxes[node.path]
    while node.parent in nodes and nodes[node.parent].role != ROLES['frame']:
        node = nodes[node.parent]
        left, top, wide, high = boxes.get(node.path, (x, y, width, height))
        if x < left or y < top or x + width > left + wide or y + height > top + high:
            return False
    return True


def usable(node, nodes):
    """A label within a button that cannot be pressed now does not say so itself."""
    while node.states >> SENSITIVE & 1 and node.parent in nodes:
        node = nodes[node.parent]
    return node.states >> SENSITIVE & 1 or node.role == ROLES['frame'] or node.parent not in nodes


def faint(editor, where, known, least=4.5):
    """Texts with less than @least : 1, a line each. A page that goes away is still told for a moment when its
    place shows another one, so a text counts that is faint in each of three looks."""
    told = look_once(editor, where, known, least)
    for _ in range(2):
        if not told:
            break
        time.sleep(0.5)
        again = look_once(editor, where, known, least)
        told = [each for each in told if each in again]
    return told


def look_once(editor, where, known, least):
    """The same of one picture, except @known (path and name), which gets those that are good."""
    about = sh('xwininfo', '-id', editor.window)
    left, top, width, height = [int(each.split()[-1]) for each in about.splitlines()
                                if each.strip().startswith(('Absolute', 'Width', 'Height'))]
    nodes = {node.path: node for node in editor.walk()}
    boxes = editor.ask([(path, *EXTENTS) for path in nodes])
    boxes = {path: box[0] for path, box in zip(nodes, boxes) if box}
    frame = next(boxes[node.path] for node in nodes.values() if node.role == ROLES['frame'])
    texts = [node for node in nodes.values() if node.role in (ROLES['label'], ROLES['text']) and
             node.path in boxes and node.name.strip() and usable(node, nodes)]
    typed = editor.ask([(node.path, 'Text', 'GetText', 'ii', 0, 1 << 20) for node in texts])
    # An empty label has a name but draws nothing: another widget may pass there.
    texts = [node for node, text in zip(texts, typed) if text and text[0].strip() or
             text is None and node.role == ROLES['label']]
    picture, told = Picture(), []
    for node in texts:
        box = boxes[node.path]
        if min(box[2:]) < 2 or (node.path, node.name) in known or not whole(node, nodes, boxes):
            continue
        x, y, w, h = [SCALE * each for each in box]
        value = ink(picture.colors(left + width // 2 - frame[2] + x, top + height // 2 - frame[3] + y, w, h))
        if value is not None and value >= least:
            known.add((node.path, node.name))
        elif value is not None:
            told.append('%s: "%s" is %.2f : 1' % (where, node.name, value))
    return told


def look(screen, theme, name, kind=Editor):
    """The window with a program, simulated, and each panel below the sheet. @name: of the pictures."""
    editor = kind(screen, os.path.join(ROOT, 'ladders', 'garage-door.rung'), GDK_SCALE=str(SCALE),
                  ADW_DEBUG_COLOR_SCHEME='prefer-' + theme)
    editor.to_sheet()
    known = set()
    told = faint(editor, 'the sheet', known)
    editor.shot('contrast-' + name)
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    told += faint(editor, 'simulating', known)
    editor.keys('ctrl+alt+w')
    until(lambda: [node for node in editor.all('New value') if node.name.startswith('StopOk')], 'the line of StopOk')
    told += faint(editor, 'Status chart', known)
    editor.keys('ctrl+F5')
    editor.find('passed')
    told += faint(editor, 'Scenarios', known)
    for tab in 'Cross reference', 'Status chart', 'Timing chart', 'Scenarios', 'Instruction list', 'Alarms', 'Log', 'Board':
        editor.find(tab, 'page tab').press()
        until(lambda: editor.find(tab, 'page tab').states >> SELECTED & 1, 'the tab ' + tab)
        told += faint(editor, tab, known)
        editor.shot('contrast-%s-%s' % (name, tab.split()[0]))
    editor.keys('ctrl+alt+s')
    editor.find('Add a symbol', 'push button')
    told += faint(editor, 'the symbols', known)
    editor.shot('contrast-%s-symbols' % name)
    assert not told, '\n'.join(told)
    assert len(known) >= 100, 'only %d texts were seen' % len(known)


def light(screen):
    """light: no text has less contrast than 4.5 : 1, in the window, while simulating, in each panel"""
    look(screen, 'light', 'light')


def dark(screen):
    """dark: the same"""
    look(screen, 'dark', 'dark')


def small_light(screen):
    """1024x700, in Chinese: the same"""
    look(screen, 'light', 'small-light', Chinese)


def small_dark(screen):
    """1024x700, in Chinese and in the dark: the same"""
    look(screen, 'dark', 'small-dark', Chinese)


def choose_contrast(editor, key):
    """Chooses the row of "Contrast" above or below the chosen one in the preferences and closes them."""
    editor.keys('ctrl+comma')
    editor.focus_on('Light or dark')
    editor.keys('Tab')
    editor.focus_on('Contrast')
    count = lambda: len(editor.all('as the desktop', 'label'))
    rows = count()
    editor.keys('Return')
    until(lambda: count() > rows, 'the list')
    editor.keys(key, 'Return')
    editor.shot('contrast-chosen')
    urge(lambda: not editor.all('Contrast'), lambda: editor.keys('Escape'), 'the preferences to be gone')


def is_black(editor, where):
    """Is anything drawn there in pure black? The ink of the usual contrast is #1d2125, that of the panel grey."""
    x, y, width, height = editor.place(where)
    return Picture().colors(x, y, width, height)[(0, 0, 0)] >= 50


def chosen(screen):
    """high contrast chosen in the preferences: sheet, panels and texts follow at once, 7 : 1; another start has it too"""
    path = os.path.join(ROOT, 'ladders', 'garage-door.rung')
    env = {'GSETTINGS_BACKEND': 'keyfile', 'GDK_SCALE': str(SCALE), 'ADW_DEBUG_COLOR_SCHEME': 'prefer-light'}
    editor = Editor(screen, path, **env)
    editor.to_sheet()
    assert not is_black(editor, editor.sheet())
    choose_contrast(editor, 'Down')
    until(lambda: is_black(editor, editor.sheet()), 'the sheet in high contrast')
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    known = set()
    told = faint(editor, 'simulating', known, 7)
    for tab in 'Status chart', 'Timing chart', 'Scenarios':
        editor.tab(tab)
        until(lambda: editor.find(tab, 'page tab').states >> SELECTED & 1, 'the tab ' + tab)
        told += faint(editor, tab, known, 7)
        editor.shot('contrast-high-' + tab.split()[0])
    assert not told, '\n'.join(told)
    assert len(known) >= 60, 'only %d texts were seen' % len(known)
    editor.finish()
    editor = Editor(screen, path, **env)
    editor.to_sheet()
    until(lambda: is_black(editor, editor.sheet()), 'the sheet in high contrast after another start')
    choose_contrast(editor, 'Up')
    until(lambda: not is_black(editor, editor.sheet()), 'the usual contrast')


light.size = dark.size = chosen.size = '2880x1800x24'
small_light.size = small_dark.size = '2048x1400x24'
if __name__ == "__main__": main([light, dark, small_light, small_dark, chosen])
