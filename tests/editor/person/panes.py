#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""panes - random tabs, panels, panes and sizes of the window: the middle of the window is never blank, and GTK warns of
nothing.

Each run has a seed, so a failure can be repeated: panes.py NUMBER… uses those seeds.
"""
import os
import random
import re
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, main, sh, until  # noqa: E402

PROJECT = os.path.join(ROOT, 'tests', 'classic', 'projects', 'linuxcnc.clp')
ACTS = 40
COLOURS = 12  # a page with any text has more, a blank one has two or three
SIZES = ['1440 900', '1024 700', '1200 640', '1340 820']
KEYS = ['F4', 'shift+F4', 'ctrl+F4', 'ctrl+m', 'ctrl+f', 'Escape', 'ctrl+alt+o', 'ctrl+alt+s', 'shift+F12', 'ctrl+Page_Down',
        'ctrl+Page_Up', 'ctrl+shift+w', 'ctrl+r', 'ctrl+period', 'ctrl+plus', 'ctrl+minus', 'ctrl+z', 'Down', 'alt+Left']


def warnings(editor):
    """GTK 4.8 warns of its own selection in an entry when it loses the focus; nothing is wrong there."""
    return [line for line in editor.logged().splitlines() if re.search('WARNING|CRITICAL|ERROR', line) and
            'unexpected blinking selection' not in line]


def colours(editor):
    """Number of colours between the header and the status bar, from the tree to the right edge."""
    x, y, width, height = editor.place(editor.all(role='frame')[0])
    picture = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '%dx%d+%d+%d' % (
        width * 6 // 10, height * 7 // 10, x + width // 4, y + height * 3 // 20), 'rgb:-'], capture_output=True).stdout
    return len({picture[at:at + 3] for at in range(0, len(picture), 3)})


def whole(editor, what):
    """Waits for the middle of the window to show something; GTK may take a frame or two."""
    editor.alive()
    assert not warnings(editor), (what, warnings(editor))
    until(lambda: colours(editor) >= COLOURS, 'a picture in the window after ' + ', '.join(what[-4:]), 3)


def sheets(editor, least=2):
    """The labels of the tabs of sheets; AdwTab has no role."""
    found = [node for node in editor.all(role='label') if node.name and node.has(30) and
             50 < node.box()[1] < 85 and node.box()[0] > 220]
    assert len(found) >= least, 'no tabs'
    return found


class Hand:
    def __init__(self, editor, number):
        self.editor, self.dice = editor, random.Random(number)

    def act(self):
        """Does something; returns what."""
        editor, chance = self.editor, self.dice.random()
        if chance < 0.35:
            tabs = [node for node in editor.all(role='page tab') if node.has(30)] + sheets(editor, 0)
            if tabs:
                tab = self.dice.choice(tabs)
                editor.click(tab)
                return 'a click on the tab ' + tab.name
        if chance < 0.45 and (report := editor.all('Show report', 'push button')):
            editor.click(report[0])
            return 'Show report'
        if chance < 0.55:
            size = self.dice.choice(SIZES)
            sh('xdotool', 'windowsize', '--sync', editor.window, *size.split())
            return 'the size ' + size
        if chance < 0.7:
            return self.divide()
        key = self.dice.choice(KEYS)
        editor.keys(key)
        return key

    def divide(self):
        """Drags where a divider may be."""
        x, y, width, height = self.editor.place(self.editor.all(role='frame')[0])
        start = self.dice.choice([(x + width // 2, y + height * 7 // 10), (x + 225, y + height // 2), (x + width - 260, y + height // 2)])
        end = (start[0] + self.dice.randrange(-200, 200), start[1] + self.dice.randrange(-200, 120))
        self.editor.drag(start, end, steps=4)
        return 'a drag from %d %d to %d %d' % (*start, *end)


def opened(screen):
    path = shutil.copy(PROJECT, screen.home)
    editor = Editor(screen, path)
    editor.find('Show report', 'push button')
    return editor


def report(screen):
    """an imported project: a click on another tab after its report shows that tab"""
    editor = opened(screen)
    editor.click(editor.find('Show report', 'push button'))
    editor.find('Left out', 'label')
    editor.shot('panes-report')
    whole(editor, ['Show report'])
    for tab in sheets(editor):
        editor.click(tab)
        time.sleep(0.5)
        whole(editor, ['Show report', tab.name])
    editor.shot('panes-other')


def in_page(node):
    """A widget below the tabs, right of the tree."""
    x, y, width, height = node.box()
    return x > 215 and y > 85 and height > 0


def tabs(screen):
    """a click on any tab gives its page the keys, also on the one in front; the tree selects what is in front"""
    editor = opened(screen)
    for tab in sheets(editor):
        for _ in range(2):  # the second click finds the tab in front and the focus in the tree
            tree = [node for node in editor.all('Prog1', 'list item') if node.name.startswith('Prog1')][0]
            editor.click(tree)
            editor.click(tab)
            until(lambda: (node := editor.focused()) and in_page(node), 'the focus in the page of ' + tab.name)
            if tab.name == 'Prog1':
                editor.keys('x')
                editor.find('element and operand', 'text')
                editor.keys('Escape')
        until(lambda: [node for node in editor.all(tab.name) if node.has(23) and node.box()[0] < 215], 'its row in the tree')


def storm(screen, number):
    editor = opened(screen)
    hand, done = Hand(editor, number), []
    for _ in range(ACTS):
        done.append(hand.act())
        whole(editor, done)
    editor.shot('panes-%d' % number)


def of(number):
    def test(screen):
        storm(screen, number)
    test.__doc__ = 'dice %d: tabs, panels, panes and sizes; a picture after each step, and no warning' % number
    return test


numbers = [int(number) for number in sys.argv[1:] if number.isdigit()] or (2, 3)
tests = [test for test in (report, tabs) if test.__name__ in sys.argv[1:]] or \
        [*([] if sys.argv[1:] else [report, tabs]), *(of(number) for number in numbers)]
del sys.argv[1:]
main(tests)
