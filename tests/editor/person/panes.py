#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""panes - random tabs, panels, panes and sizes of the window: the middle of the window is never blank, and GTK warns of
nothing.

Each run has a seed, so a failure can be repeated: panes.py NUMBER… uses those seeds.
"""
import os
import shutil
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import ROOT, Editor, main, until  # noqa: E402
from rooms import Hand, sheets, whole  # noqa: E402

PROJECT = os.path.join(ROOT, 'tests', 'classic', 'projects', 'linuxcnc.clp')
ACTS = 40
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
