#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""storm - keys, clicks, drags and texts in whatever order: the editor goes on, and undo takes back all.

The dice are thrown from a number, so that what was found is found again:
storm.py NUMBER… throws those instead of its own.
"""
import difflib
import os
import random
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, check, main, new_file, sh, until  # noqa: E402

ACTS, AT_ONCE = 96, 16
# Another window, or none, that the rest of the keys would go to; a printer; any command.
LEFT_OUT = {'new_project', 'open', 'save_as', 'close', 'print', 'palette', 'preferences', 'shortcuts', 'fullscreen'}
NAMES = {'Control': 'ctrl', 'Shift': 'shift', 'Alt': 'alt'}
WORDS = ['Start', 'OUT Motor', 'TON T9 2s', 'XIO %IX0.3', 'CTU', '= Lamp', 'OR Stop', 'x := y + 1', '%QX9.9.9', '(* no *)',
         'a b', '12', '-1', '"', 'LD', 'S Alarm', 'N Valve', 'T#3s', 'RS', 'END_RUNG']


def keys_of_window():
    """All of the one table, and those of hands and texts."""
    keys = ['Up', 'Down', 'Left', 'Right', 'Home', 'End', 'Tab', 'shift+Tab', 'Return', 'shift+Down', 'shift+Right', *['Escape'] * 8]
    with open(os.path.join(ROOT, 'editor-gtk', 'kit', 'verbs.def')) as table:
        for verb, accels in re.findall(r'^VERB\((\w+),\s*\w+,\s*"([^"]*)"', table.read(), re.MULTILINE):
            for accel in filter(None, accels.split('|') if verb not in LEFT_OUT else []):
                held = [NAMES[name] for name in re.findall('<(.*?)>', accel)]
                keys.append('+'.join(held + [re.sub('<.*?>', '', accel)]))
    return keys


class Hand:
    """Of somebody who does not look."""

    def __init__(self, editor, number):
        self.editor, self.dice, self.keys = editor, random.Random(number), keys_of_window()
        self.left, self.top, self.width, self.height = editor.place(editor.all(role='frame')[0])

    def point(self):
        """Somewhere below the heading with its buttons that close the window."""
        x = self.left + self.dice.randrange(10, self.width - 10)
        return [str(x), str(self.top + self.dice.randrange(60, self.height - 10))]

    def act(self):
        chance = self.dice.random()
        if chance < 0.6:
            return ['key', self.dice.choice(self.keys)]
        if chance < 0.75:
            return ['type', '--delay', '1', self.dice.choice(WORDS), 'key', self.dice.choice(['Return', 'Return', 'Escape', 'Tab'])]
        if chance < 0.9:
            return ['mousemove', *self.point(), 'click', *self.dice.choice(
                [['1'], ['1'], ['3'], ['--repeat', '2', '--delay', '30', '1']])]
        return ['mousemove', *self.point(), 'mousedown', '1', 'sleep', '0.03', 'mousemove', *self.point(), 'sleep', '0.03',
                'mousemove', *self.point(), 'sleep', '0.03', 'mouseup', '1']

    def acts(self, count):
        return [word for _ in range(count) for word in [*self.act(), 'sleep', '0.01']]


def faults(editor):
    """What the toolkit says of us. That it leaves a widget out of a frame it says of its own: of
    scrollbars beside a text, and when a tab is dragged while a menu closes; the next frame has it."""
    return [line for line in editor.logged().splitlines() if re.search('WARNING|CRITICAL|ERROR', line) and
            not re.search(r'Trying to snapshot \w+ \w+ without a current allocation', line)]


def calm(editor):
    """Whatever is open goes; what runs stops."""
    editor.keys('Escape', 'Escape', 'Escape', 'Escape')
    until(lambda: editor.windows() == [editor.window] or editor.keys('Escape'), 'other windows to go')
    editor.keys('ctrl+shift+r')


def is_unsaved(editor):
    """The mark stands before the name in the heading; a tab may have one, too."""
    return any(node.name.startswith('• ') and node.box()[1] < 50 for node in editor.all('• ', 'label'))


def saved(editor, path):
    """The program, not a text beside it that may be in front."""
    editor.keys(*['ctrl+Page_Up'] * 12)
    until(lambda: not editor.keys('ctrl+s') and not is_unsaved(editor), 'the program to be saved')
    with open(path) as text:
        return text.read()


def all_the_way(editor, button, key, path):
    """Undoes all there is, or does it again, and saves."""
    until(lambda: not editor.find(button, 'push button').has(24) or editor.keys(*[key] * 30), 'the end of ' + button)
    return saved(editor, path)


def same(wanted, text, why):
    assert text == wanted, '\n'.join([why, *difflib.unified_diff(wanted.splitlines(), text.splitlines(), lineterm='')])


def storm(screen, number):
    folder = os.path.join(ROOT, 'ladders')
    names = sorted(name for name in os.listdir(folder) if name.endswith('.rung') and 'plant' not in name)
    name = names[number % len(names)]
    with open(os.path.join(folder, name)) as text:
        first = text.read()
    path = new_file(screen, first)
    editor = Editor(screen, path)
    editor.focus_on()
    hand = Hand(editor, number)
    for at in range(0, ACTS, AT_ONCE):
        acts = hand.acts(AT_ONCE)
        sh('xdotool', *acts)
        editor.alive()
        assert not faults(editor), (at, acts, faults(editor))
    editor.shot('storm-%d' % number)
    calm(editor)
    last = all_the_way(editor, 'Redo', 'ctrl+y', path)
    same(first, all_the_way(editor, 'Undo', 'ctrl+z', path), 'undone all, it is another')
    check(path)
    same(last, all_the_way(editor, 'Redo', 'ctrl+y', path), 'done again, it is another')
    assert not faults(editor), faults(editor)
    print('# %s: %d lines became %d' % (name, len(first.splitlines()), len(last.splitlines())))


def of(number):
    def test(screen):
        storm(screen, number)
    test.__doc__ = 'dice %d: it goes on, complains of nothing, and undo takes back all' % number
    return test


numbers = [int(number) for number in sys.argv[1:]] or (12, 13, 18)
del sys.argv[1:]
main([of(number) for number in numbers])
