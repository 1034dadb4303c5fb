#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""storm - random keys, clicks, drags and texts: the editor goes on, and undo restores the beginning.

Each run has a seed, so a failure can be repeated: storm.py NUMBER… uses those seeds.
"""
import difflib
import os
import random
import re
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, check, main, new_file, sh, until  # noqa: E402
import rooms  # noqa: E402

ACTS, AT_ONCE = 96, 16
ROOMS = 2  # acts in the rooms of the window after each AT_ONCE
# Keys that open another window, which would get the rest of the keys; a printer; any command.
LEFT_OUT = {'new_project', 'open', 'save_as', 'close', 'print', 'palette', 'preferences', 'shortcuts', 'fullscreen'}
NAMES = {'Control': 'ctrl', 'Shift': 'shift', 'Alt': 'alt'}
WORDS = ['Start', 'OUT Motor', 'TON T9 2s', 'XIO %IX0.3', 'CTU', '= Lamp', 'OR Stop', 'x := y + 1', '%QX9.9.9', '(* no *)',
         'a b', '12', '-1', '"', 'LD', 'S Alarm', 'N Valve', 'T#3s', 'RS', 'END_RUNG']


def keys_of_window():
    """All keys of verbs.def, and usual others."""
    keys = ['Up', 'Down', 'Left', 'Right', 'Home', 'End', 'Tab', 'shift+Tab', 'Return', 'shift+Down', 'shift+Right', *['Escape'] * 8]
    with open(os.path.join(ROOT, 'editor-gtk', 'kit', 'verbs.def')) as table:
        for verb, accels in re.findall(r'^VERB\((\w+),\s*\w+,\s*"([^"]*)"', table.read(), re.MULTILINE):
            for accel in filter(None, accels.split('|') if verb not in LEFT_OUT else []):
                held = [NAMES[name] for name in re.findall('<(.*?)>', accel)]
                keys.append('+'.join(held + [re.sub('<.*?>', '', accel)]))
    return keys


class Hand:
    """A hand whose owner does not look."""

    def __init__(self, editor, number):
        self.editor, self.dice, self.keys = editor, random.Random(number), keys_of_window()

    def point(self):
        """A point below the heading, whose buttons close the window."""
        x = self.left + self.dice.randrange(10, self.width - 10)
        return [str(x), str(self.top + self.dice.randrange(60, self.height - 10))]

    def act(self):
        chance = self.dice.random()
        if chance < 0.6:
            return ['key', self.dice.choice(self.keys)]
        if chance < 0.75:
            return ['type', '--delay', '1', '--args', '1', self.dice.choice(WORDS), 'key', self.dice.choice(['Return', 'Return', 'Escape', 'Tab'])]
        if chance < 0.9:
            return ['mousemove', *self.point(), 'click', *self.dice.choice(
                [['1'], ['1'], ['3'], ['--repeat', '2', '--delay', '30', '1']])]
        return ['mousemove', *self.point(), 'mousedown', '1', 'sleep', '0.03', 'mousemove', *self.point(), 'sleep', '0.03',
                'mousemove', *self.point(), 'sleep', '0.03', 'mouseup', '1']

    def acts(self, count):
        """Where the window is now: a click beside it takes the keys away from it."""
        self.left, self.top, self.width, self.height = self.editor.place()
        return [word for _ in range(count) for word in [*self.act(), 'sleep', '0.01']]


def go_round(editor, place, acts):
    """Tabs, pages, panels, dividers and sizes of the window; it is never blank."""
    rooms.alone(editor)
    for _ in range(ROOMS):
        acts = [*acts, place.act()]
        rooms.whole(editor, acts)


def calm(editor):
    """Closes what is open and stops what runs."""
    rooms.alone(editor)
    editor.keys('ctrl+shift+r')


def is_unsaved(editor):
    """Is the mark before the name in the heading? A tab may have one, too."""
    return any(node.name.startswith('• ') and node.box()[1] < 50 for node in editor.all('• ', 'label'))


def to_program(editor):
    """A file beside the program may be in front, an I/O map or a scenario: it has a history of its own."""
    editor.keys(*['ctrl+Page_Up'] * 12)
    for tab in rooms.sheets(editor, 0):
        if not re.search(r'\.(io|scn|txt)$', tab.name):
            editor.click(tab)
            return


def saved(editor, path):
    """Saves the program."""
    to_program(editor)
    until(lambda: not editor.keys('ctrl+s') and not is_unsaved(editor), 'the program to be saved')
    with open(path) as text:
        return text.read()


def all_the_way(editor, button, key, path):
    """Undoes or redoes everything, and saves."""
    to_program(editor)
    until(lambda: not editor.find(button, 'push button').has(24) or editor.keys(*[key] * 30), 'the end of ' + button)
    return saved(editor, path)


def same(wanted, text, why):
    assert text == wanted, '\n'.join([why, *difflib.unified_diff(wanted.splitlines(), text.splitlines(), lineterm='')])


def beginnings():
    """The samples of one file, in all five languages."""
    folder = os.path.join(ROOT, 'ladders')
    return sorted(path for name in os.listdir(folder) for path in (os.path.join(folder, name), os.path.join(folder, name, name + '.rung'))
                  if path.endswith('.rung') and 'plant' not in path and os.path.exists(path))


def storm(screen, number):
    samples = beginnings()
    sample = samples[number % len(samples)]
    with open(sample) as text:
        first = text.read()
    path = new_file(screen, first)
    if os.path.exists(sample[:-5] + '.io'):
        shutil.copy(sample[:-5] + '.io', path[:-5] + '.io')
    editor = Editor(screen, path)
    editor.focus_on()
    hand, place = Hand(editor, number), rooms.Hand(editor, number)
    for at in range(0, ACTS, AT_ONCE):
        acts = hand.acts(AT_ONCE)
        sh('xdotool', *acts)
        editor.alive()
        assert not rooms.warnings(editor), (at, acts, rooms.warnings(editor))
        go_round(editor, place, acts)
    editor.shot('storm-%d' % number)
    calm(editor)
    last = all_the_way(editor, 'Redo', 'ctrl+y', path)
    same(first, all_the_way(editor, 'Undo', 'ctrl+z', path), 'undone all, it is another')
    check(path)
    same(last, all_the_way(editor, 'Redo', 'ctrl+y', path), 'done again, it is another')
    assert not rooms.warnings(editor), rooms.warnings(editor)
    print('# %s: %d lines became %d' % (os.path.basename(sample), len(first.splitlines()), len(last.splitlines())))


def of(number):
    def test(screen):
        storm(screen, number)
    test.__doc__ = 'dice %d: it goes on, complains of nothing, and undo takes back all' % number
    return test


numbers = [int(number) for number in sys.argv[1:]] or (1, 8, 13, 35)
del sys.argv[1:]
main([of(number) for number in numbers])
