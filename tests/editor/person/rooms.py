# SPDX-License-Identifier: MIT
"""rooms - what a storm does with the rooms of the window: tabs, pages, panels, dividers and sizes; and whether the middle of
the window shows something.
"""
import random
import re
import subprocess
import time

from desk import sh, until
from node import Gone

TABS_END = 98  # px from the top of the window
COLOURS = 4  # a sheet with one wire has five, a blank page two or three
SIZES = ['1440 900', '1024 700', '1200 640', '1340 820']
KEYS = ['F4', 'shift+F4', 'ctrl+F4', 'ctrl+m', 'ctrl+f', 'Escape', 'ctrl+alt+o', 'ctrl+alt+s', 'shift+F12', 'ctrl+Page_Down',
        'ctrl+Page_Up', 'ctrl+shift+w', 'ctrl+1', 'ctrl+2', 'ctrl+3', 'ctrl+4',  # the last four: Show as
        'ctrl+r', 'ctrl+period', 'ctrl+plus', 'ctrl+minus', 'ctrl+z', 'Down', 'alt+Left']


def warnings(editor):
    """What the toolkit warns of: each is a fault of the editor, or has a workaround in kit/gtk48."""
    return [line for line in editor.logged().splitlines() if re.search('WARNING|CRITICAL|ERROR', line)]


def colours(editor):
    """Number of colours from below the tabs to the panels, from the tree to the right edge."""
    x, y, width, height = editor.place()
    picture = subprocess.run(['import', '-window', 'root', '-depth', '8', '-crop', '%dx%d+%d+%d' % (
        width * 6 // 10, height * 7 // 10, x + width // 4, y + TABS_END), 'rgb:-'], capture_output=True).stdout
    return len({picture[at:at + 3] for at in range(0, len(picture), 3)})


def whole(editor, what):
    """Waits for the middle of the window to show something; GTK may take a frame or two."""
    editor.alive()
    assert not warnings(editor), (what, warnings(editor))
    until(lambda: colours(editor) >= COLOURS, 'a picture in the window after ' + ', '.join(what[-4:]), 3)


def alone(editor):
    """Escape closes each other window, also one that comes late. The manual stays open beside the window until it has the
    keys."""
    editor.keys('Escape', 'Escape', 'Escape', 'Escape')

    def look():
        others = [window for window in editor.windows() if window != editor.window]
        if others:
            sh('xdotool', 'windowactivate', others[-1], 'sleep', '0.1', 'key', 'Escape')
        return not others
    until(lambda: look() and (time.sleep(0.3) or look()), 'other windows to go')


def standing(nodes, fits):
    """Those that fit, without those that go while they are asked."""
    found = []
    for node in nodes:
        try:
            found += [node] if fits(node) else []
        except Gone:
            pass
    return found


def sheets(editor, least=2):
    """The labels of the tabs of sheets; AdwTab has no role."""
    found = standing(editor.all(role='label'), lambda node: node.name and node.states >> 30 & 1 and
                     50 < node.box()[1] < 85 and node.box()[0] > 220)
    assert len(found) >= least, 'no tabs'
    return found


PAGES = ['Tasks', 'Data types', 'Symbols', 'Address map', 'Welcome and samples', 'Compare', 'Import or export report']
FILTERS = ['Filter the addresses', 'Filter']
SEARCHED = ['Start', 'MW', 'timer', 'no such word', '%']


class Hand:
    def __init__(self, editor, number):
        self.editor, self.dice = editor, random.Random(number)

    def act(self):
        """Does something; returns what."""
        editor, chance = self.editor, self.dice.random()
        if chance < 0.35:
            tabs = standing(editor.all(role='page tab'), lambda node: node.states >> 30 & 1) + sheets(editor, 0)
            # A tab that is scrolled out of a small window has a place beside it.
            width = editor.place()[2]
            tabs = standing(tabs, lambda node: node.box()[0] + node.box()[2] < width)
            if tabs:
                return self.tab(self.dice.choice(tabs))
        if chance < 0.45 and (report := editor.all('Show report', 'push button')):
            editor.click(report[0])
            return 'Show report'
        if chance < 0.55:
            size = self.dice.choice(SIZES)
            sh('xdotool', 'windowsize', '--sync', editor.window, *size.split())
            return 'the size ' + size
        if chance < 0.7:
            return self.divide()
        if chance < 0.78:
            return self.page()
        if chance < 0.82:
            return self.manual()
        if chance < 0.88:
            return self.search()
        if chance < 0.92:
            return self.map()
        key = self.dice.choice(KEYS)
        editor.keys(key)
        return key

    def tab(self, tab):
        """The tab of a panel has another name when its number changes."""
        try:
            self.editor.click(tab)
            return 'a click on the tab ' + tab.name
        except Gone:
            return 'no click on the tab ' + tab.name

    def page(self):
        """Opens a page by its command; closes a chooser that asks for a file. A menu that is open has the keys."""
        name = self.dice.choice(PAGES)
        alone(self.editor)
        self.editor.command(name)
        alone(self.editor)
        return 'the command ' + name

    def manual(self):
        """Opens the manual in some size, searches in all pages and in one, and closes it."""
        editor, word = self.editor, self.dice.choice(SEARCHED)
        size = self.dice.choice([*SIZES, '640 420'])
        alone(editor)
        editor.command('Manual')  # F1 may have opened it already
        window = until(lambda: next((one for one in editor.windows() if one != editor.window and
                                     sh('xdotool', 'getactivewindow') == one), None), 'the manual with the keys in it')
        sh('xdotool', 'windowsize', '--sync', window, *size.split())
        for key in 'ctrl+shift+f', 'ctrl+f':
            editor.keys(key)
            editor.type(word)
            editor.keys('Return', self.dice.choice(['Return', 'Next', 'ctrl+a', 'ctrl+shift+c', 'F3']))
        alone(editor)
        return 'the manual at %s, searched for %s' % (size, word)

    def map(self):
        """Opens the I/O map by its row of the tree, if the program has one."""
        rows = standing(self.editor.all('.io', 'list item'), lambda node: node.box()[2] > 0)
        if not rows:
            return 'no I/O map'
        self.editor.click(rows[0], count=2)
        return 'the I/O map'

    def search(self):
        """Types into a filter that is visible."""
        editor, word = self.editor, self.dice.choice(SEARCHED)
        lines = [node for name in FILTERS for node in editor.all(name, 'text') if node.box()[2] > 0]
        if not lines:
            return 'no filter'
        line = self.dice.choice(lines)
        editor.click(line)
        editor.keys('ctrl+a')
        editor.type(word)
        editor.keys(self.dice.choice(['Escape', 'Down', 'Tab']))
        return 'the filter %s with %s' % (line.name, word)

    def divide(self):
        """Drags where a divider may be."""
        x, y, width, height = self.editor.place()
        start = self.dice.choice([(x + width // 2, y + height * 7 // 10), (x + 225, y + height // 2), (x + width - 260, y + height // 2)])
        end = (start[0] + self.dice.randrange(-200, 200), start[1] + self.dice.randrange(-200, 120))
        self.editor.drag(start, end, steps=4)
        return 'a drag from %d %d to %d %d' % (*start, *end)


