#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A chart of four steps with a branch is drawn by keyboard alone and by pointer alone."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, trace, until  # noqa: E402

EMPTY = 'RUNGBOARD 1\n\nPROGRAM Main SFC\n  INITIAL_STEP Start:\n  END_STEP\nEND_PROGRAM\n'
# To Fill, from there to Heat by I0.1, to Drain by I0.2; back to Start by I0.3.
SCRIPT = ('@print Start.X Fill.X Heat.X Drain.X\n.\n%IX0.0=1\n%IX0.0=0 %IX0.2=1\n%IX0.2=0 %IX0.3=1\n'
          '%IX0.3=0 %IX0.0=1\n%IX0.0=0 %IX0.1=1\n')


def chart(editor):
    return until(lambda: [node for node in editor.all('Chart') if node.name == 'Chart'], 'the chart')[0]


def shapes(editor):
    return [node.name for node in editor.all(role='table cell')
            if node.name.startswith(('Step ', 'Transition ', 'Jump ')) or ' does: ' in node.name]


def shape(editor, *parts):
    def look():
        found = [node for node in editor.all(role='table cell') if all(part in node.name for part in parts)]
        return found[0] if found else None
    return until(look, 'what is called %s' % ', '.join(parts))


def at(editor, text):
    """Waits until the cursor is on the shape whose name has this text."""
    until(lambda: shape(editor, text).has(23), 'the cursor at ' + text)


def on_chart(editor):
    until(lambda: chart(editor).has(12), 'the focus on the chart')


def typed(editor, text):
    """Types into the entry that the first letter opens."""
    on_chart(editor)
    editor.type(text[0])
    editor.opened()
    editor.entry(text[1:])
    on_chart(editor)


def asked(editor, key, text):
    on_chart(editor)
    editor.keys(key)
    editor.opened()
    editor.entry(text)
    on_chart(editor)


def finished(editor, path):
    """Saves; the file must pass the check and run as expected."""
    text = editor.save(path)
    for line in ('TRANSITION FROM Start TO Fill := %IX0.0;', 'TRANSITION FROM Fill TO Heat := %IX0.1;',
                 'TRANSITION FROM Fill TO Drain := %IX0.2;', 'TRANSITION FROM Heat TO Start := %IX0.3;',
                 'TRANSITION FROM Drain TO Start := %IX0.3;', '%QX0.0(N);', '%QX0.1(L, T#5s);'):
        assert line in text, (line, text)
    check(path)
    return text


def active(path):
    """Returns the active step after each scan of the script."""
    return [' '.join(re.findall(r'(\w+)\.X=1', line)) for line in trace(path, SCRIPT).splitlines()]


def by_keyboard(screen):
    """by the keyboard alone"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    on_chart(editor)
    shape(editor, 'Step Start, initial')
    editor.keys('Insert')
    at(editor, 'Step Step1')
    typed(editor, 'Fill')
    at(editor, 'Step Fill')
    asked(editor, 'F9', 'Q0.0')
    shape(editor, 'Fill does: N %QX0.0')
    editor.keys('Insert')
    at(editor, 'Step Step1')
    typed(editor, 'Heat')
    at(editor, 'Step Heat')
    editor.keys('Up')
    at(editor, 'from Fill to Heat')
    typed(editor, 'I0.1')
    shape(editor, 'from Fill to Heat, condition %IX0.1')
    editor.keys('Up')
    at(editor, 'Step Fill')
    editor.keys('F6')
    at(editor, 'Step Step1')
    typed(editor, 'Drain')
    at(editor, 'Step Drain')
    asked(editor, 'F9', 'L T#5s Q0.1')
    shape(editor, 'Drain does: L T#5s %QX0.1')
    asked(editor, 'F8', 'Start')
    at(editor, 'from Drain to Start')
    typed(editor, 'I0.3')
    editor.keys('Up')
    at(editor, 'Step Drain')
    editor.keys('Up')
    at(editor, 'from Fill to Drain')
    typed(editor, 'I0.2')
    editor.keys('Left')
    at(editor, 'from Fill to Heat')
    editor.keys('Down')
    at(editor, 'Step Heat')
    asked(editor, 'F8', 'Start')
    at(editor, 'from Heat to Start')
    typed(editor, 'I0.3')
    editor.keys('Home')
    at(editor, 'Step Start')
    editor.keys('Down')
    at(editor, 'from Start to Fill')
    typed(editor, 'I0.0')
    editor.shot('chart-keyboard')
    text = finished(editor, path)
    # Back to the beginning, and forth again: the same bytes.
    for _ in range(40):
        editor.keys('ctrl+z')
    until(lambda: len(shapes(editor)) == 1, 'the first step alone')
    assert editor.save(path) == EMPTY
    for _ in range(40):
        editor.keys('ctrl+y')
    until(lambda: len([name for name in shapes(editor) if name.startswith('Step')]) == 4, 'all steps')
    assert editor.save(path) == text
    assert active(path) == ['Start', 'Fill', 'Drain', 'Start', 'Fill', 'Heat'], active(path)


def below(editor, node):
    """The lower edge of a step, where a drag begins a way."""
    x, y, width, height = editor.place(node)
    return x + width // 2, y + height - 4


def upon(editor, node):
    """The bar of a transition, or the box of a step."""
    x, y, _, height = editor.place(node)
    return x + 11, y + height // 2


def menu(editor, node, verb):
    editor.click(upon(editor, node), button=3)
    item = until(lambda: editor.all(verb, 'menu item'), 'the menu')[0]
    item.press()


def chosen(editor, node, verb, text=None):
    """Chooses from the menu of a shape and types into the entry that opens."""
    menu(editor, node, verb)
    if text:
        editor.opened()
        editor.entry(text)
    on_chart(editor)


def twice(editor, node, text):
    """Double-clicks a shape; its entry opens."""
    editor.click(upon(editor, node), count=2)
    editor.opened()
    editor.entry(text)
    on_chart(editor)


def lead(editor, start, end, look=None):
    """Draws a way; the pointer rests at its beginning first, as a hand does."""
    editor.click(upon(editor, shape(editor, start)))
    at(editor, start)
    editor.drag(below(editor, shape(editor, start)), shape(editor, end), look=look)


def by_pointer(screen):
    """by the pointer alone, except for names and conditions"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    chosen(editor, shape(editor, 'Step Start'), 'Step and transition below')
    twice(editor, shape(editor, 'Step Step1'), 'Fill')
    chosen(editor, shape(editor, 'Step Fill'), 'Step and transition below')
    twice(editor, shape(editor, 'Step Step1'), 'Heat')
    chosen(editor, shape(editor, 'Step Fill'), 'Alternative branch')
    twice(editor, shape(editor, 'Step Step1'), 'Drain')
    lead(editor, 'Step Heat', 'Step Start', 'chart-way')
    shape(editor, 'from Heat to Start')
    lead(editor, 'Step Drain', 'Step Start')
    for ways, condition in (('Start to Fill', 'I0.0'), ('Fill to Heat', 'I0.1'), ('Fill to Drain', 'I0.2'),
                            ('Heat to Start', 'I0.3'), ('Drain to Start', 'I0.3')):
        twice(editor, shape(editor, 'from ' + ways), condition)
        shape(editor, 'from %s, condition %s' % (ways, condition.replace('I', '%IX')))
    chosen(editor, shape(editor, 'Step Fill'), 'Add action to step', 'Q0.0')
    shape(editor, 'Fill does: ')  # it moves what is beside it
    chosen(editor, shape(editor, 'Step Drain'), 'Add action to step', 'L T#5s Q0.1')
    shape(editor, 'Drain does: L T#5s %QX0.1')
    editor.shot('chart-pointer')
    finished(editor, path)
    assert active(path) == ['Start', 'Fill', 'Drain', 'Start', 'Fill', 'Heat'], active(path)
    # A branch changes places with its neighbour; it is evaluated first now.
    chosen(editor, shape(editor, 'from Fill to Drain'), 'Branch to the left')
    text = editor.save(path)
    assert text.index('FROM Fill TO Drain') < text.index('FROM Fill TO Heat'), text
    # Undo restores what was deleted.
    chosen(editor, shape(editor, 'Step Drain'), 'Delete')
    until(lambda: not [name for name in shapes(editor) if 'Drain' in name], 'Drain to be gone')
    editor.keys('ctrl+z')
    shape(editor, 'Drain does: L T#5s %QX0.1')


def palette(screen):
    """tiles of the palette: clicked at the cursor, dragged onto a shape; none of them beside a list or a table"""
    path = new_file(screen, EMPTY + '\nPROGRAM Text IL\n  LD    I0.0\n  ST    Q0.5\nEND_PROGRAM\n\n'
                    'PROGRAM Rungs LD\nRUNG\n  | NO I0.0 | COIL Q0.6 |\nEND_PROGRAM\n')
    editor = Editor(screen, path)
    editor.click(editor.tile('Transition: '))  # the step at the cursor gets a transition, which asks for its condition
    editor.opened()
    editor.entry('I0.0')
    shape(editor, 'from Start to Step1, condition %IX0.0')
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find a part of a chart')
    editor.type('at most')
    until(lambda: not editor.all('Transition: ', 'push button', editor.palette), 'that tile alone')
    editor.drag(editor.tile('L: '), upon(editor, shape(editor, 'Step Step1')), look='charts-drop')
    editor.opened()
    assert [node.text() for node in editor.asked()] == ['L '], [node.text() for node in editor.asked()]
    editor.type('T#2s Q0.1')
    editor.keys('Return')
    shape(editor, 'Step1 does: L T#2s %QX0.1')
    editor.click(editor.find('Find a part of a chart'))
    editor.keys('Escape')
    editor.tile('Transition: ')
    editor.drag(editor.tile('Alternative: '), upon(editor, shape(editor, 'Step Start')))
    shape(editor, 'from Start to Step2')
    editor.drag(editor.tile('Initial step: '), upon(editor, shape(editor, 'Step Step2')))
    until(lambda: 'INITIAL_STEP Step2' in editor.save(path), 'the initial step')
    editor.keys('ctrl+z')
    editor.keys('ctrl+shift+e')
    editor.focus_on('Find a part of a chart')
    editor.type('jump')
    editor.keys('Return')
    editor.opened()
    editor.entry('Start')
    shape(editor, 'from Step2 to Start')
    editor.keys('ctrl+Page_Down')
    until(lambda: not editor.all('Find a part of a chart') and not editor.all('Find an element'), 'no palette beside a list')
    editor.keys('ctrl+Page_Down')
    editor.find('Find an element')
    for family in 'Contacts', 'Coils', 'Timers':
        x, y, width, _ = editor.place(editor.all(family, 'push button', editor.palette)[0])
        editor.click((x + width // 2, y + 10))
    until(lambda: not editor.all('TON: ', 'push button', editor.palette), 'the timers to be folded')
    editor.click(editor.tile('More kinds of CTU'))
    until(lambda: editor.all('CTU_DINT', 'menu item', editor.palette), 'the kinds of CTU')
    assert not editor.all('CTU_DINT:', 'push button', editor.palette), 'a kind for another type crowds the counters'


def bodies(screen):
    """a condition becomes a rung below the chart, an action gets rungs; pasted steps get new names"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.keys('Insert')
    at(editor, 'Step Step1')
    asked(editor, 'F9', 'ACTION Count')
    editor.keys('Up')
    at(editor, 'from Start to Step1')
    typed(editor, 'I0.0')
    editor.keys('shift+F9')
    assert 'Rung 1' in editor.element('%IX0.0').name
    editor.to_sheet()
    editor.keys('Home', 'shift+F5')
    editor.opened()
    editor.entry('I0.1')
    editor.shot('chart-rung')
    text = editor.save(path)
    assert '      | NO %IX0.1 ^|\n' in text, text
    # The action: from the line of the step to its rung, which gets a coil.
    editor.click(shape(editor, 'Step1 does: N Count'), count=2)
    until(lambda: editor.all('Action Count', 'label'), 'the heading of the action')
    editor.to_sheet()
    editor.entry('Q0.5')
    editor.entry('OUT Q0.6')
    editor.keys('Insert')
    editor.entry('OUT Q0.7')
    text = editor.save(path)
    assert text.count('    RUNG\n') == 3 and 'COIL %QX0.7' in text, text
    check(path)
    editor.keys('ctrl+z', 'ctrl+z')
    # Steps are copied as text and get new names.
    editor.click(shape(editor, 'Step Step1'))
    at(editor, 'Step Step1')
    on_chart(editor)
    editor.keys('ctrl+c', 'ctrl+v')
    shape(editor, 'Step Step1_2')
    shape(editor, 'Step1_2 does: N Count')
    text = editor.save(path)
    assert '  STEP Step1_2:\n    Count(N);\n' in text and text.count('    RUNG\n') == 2, text


RUNS = '''RUNGBOARD 1

PROGRAM Main SFC
  VAR
    Number : INT;
  END_VAR

  CONTROL(FORCE := Number);

  INITIAL_STEP Start:
  END_STEP

  TRANSITION FROM Start TO Run := Start.T >= T#20ms; END_TRANSITION

  STEP Run:
    Q0.0(N);
  END_STEP

  TRANSITION FROM Run TO Start := I0.0; END_TRANSITION

  STEP Apart:
  END_STEP

  TRANSITION FROM Apart TO Start := I0.1; END_TRANSITION
END_PROGRAM
'''


def first_key(screen):
    """the first key of an entry is kept, whatever it is: a negated condition, a time, a wrong character"""
    path = new_file(screen, RUNS)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.click(upon(editor, shape(editor, 'from Start to')))
    for line, kept in (('!Sensor', ':= NOT Sensor;'), ('Start.T > 5s', ':= Start.T > T#5s;'), ('/Sensor', ':= NOT Sensor;')):
        typed(editor, line)
        assert kept in editor.save(path), open(path).read()
    editor.shot('charts-first-key')
    editor.type('S')
    editor.opened()
    editor.type('tart.')
    editor.candidate('Start.T')
    names = [node.name.split(',')[0] for node in editor.all('Start.', 'list item')]
    assert sorted(names) == ['Start.T', 'Start.X'], 'each candidate once: %s' % names
    editor.keys('Escape')
    editor.gone()
    on_chart(editor)
    for key in '&+=[\'5#':
        editor.type(key)
        line = until(editor.asked, 'the entry of ' + key)[0]
        until(lambda: line.text() == key, key)
        editor.keys('Escape')
        editor.gone()
        on_chart(editor)
    # What is not finished is no mistake; the name of a step alone is refused and declares nothing.
    kept = open(path).read()
    for line, said in ('!', 'the operand is still missing'), ('Run', 'is a step; write Run.X'):
        editor.type(line)
        editor.opened()
        editor.says(said)
        assert not editor.all('TRANSITION', 'list item')
        editor.keys('Return')
        editor.says(said)
        editor.keys('Escape')
        editor.gone()
        on_chart(editor)
    assert open(path).read() == kept
    # The place of a mistake is a transition.
    typed(editor, 'Nobody.T > 5s')
    editor.says('Main, transition Start \u2192 ')
    editor.shot('charts-place')


def simulated(screen):
    """a running chart shows the active step and why a transition waits; a step is forced"""
    path = new_file(screen, RUNS)
    editor = Editor(screen, path)
    on_chart(editor)
    shape(editor, 'Step Start, initial')
    editor.keys('ctrl+t')
    editor.says('Simulating')
    shape(editor, 'Step Start, initial, active')
    editor.keys('ctrl+t', 'ctrl+t', 'ctrl+t')
    shape(editor, 'Step Run, active')
    until(lambda: 'Step Start, initial' in shapes(editor), 'Start to be left')
    editor.shot('chart-live')
    # The condition that the transition waits for, as rungs with power.
    editor.click(upon(editor, shape(editor, 'from Run to Start')))
    at(editor, 'from Run to Start')
    editor.keys('ctrl+F12')
    until(lambda: editor.all('Condition: Run', 'label'), 'the heading of the condition')
    editor.element('%IX0.0')
    editor.shot('chart-why')
    editor.click(upon(editor, shape(editor, 'Step Apart')))
    at(editor, 'Step Apart')
    on_chart(editor)
    editor.keys('ctrl+shift+f')
    editor.keys('ctrl+t')
    shape(editor, 'Step Apart, active')
    # One scan back, then another: the steps active then.
    editor.keys('alt+Left')
    shape(editor, 'Step Run, active')


PLAIN = RUNS.replace('  VAR\n    Number : INT;\n  END_VAR\n\n  CONTROL(FORCE := Number);\n\n', '').replace(
    '  STEP Apart:\n', '  STEP Apart:\n    SET Q0.1;\n    Q0.2(N);\n')


def forced(screen):
    """a running chart by pointer: a step is forced without CONTROL, its variables are traced"""
    assert 'CONTROL' not in PLAIN and 'Q0.2(N)' in PLAIN
    path = new_file(screen, PLAIN)
    editor = Editor(screen, path)
    shape(editor, 'Step Start, initial')
    editor.keys('ctrl+t')
    editor.says('Simulating')
    shape(editor, 'Step Start, initial, active')
    chosen(editor, shape(editor, 'Step Apart'), 'Force or release')
    shape(editor, 'Step Apart, active')
    until(lambda: 'Step Start, initial' in shapes(editor), 'Start to be left')
    editor.shot('chart-forced')
    # Added to the status chart by its menu; the chart goes on from the forced step.
    chosen(editor, shape(editor, 'Step Apart'), 'Add to the status chart')
    editor.find('Apart.X')
    editor.click(editor.find('One scan'))
    until(lambda: [node for node in editor.all('1', 'label') if node.name == '1'], 'its value')
    editor.click(editor.find('Run'))
    shape(editor, 'Step Apart, active')
    editor.shot('chart-traced')
    # One scan before the force: only the step active then.
    editor.click(editor.find('Pause'))
    editor.keys('alt+Left')
    shape(editor, 'Step Apart, active')


SEQUENCE = '''RUNGBOARD 1

PROGRAM Main SFC
  INITIAL_STEP Start:
  END_STEP

  TRANSITION FROM Start TO Fill := I0.0; END_TRANSITION

  STEP Fill:
    Q0.0(N);
  END_STEP

  TRANSITION FROM Fill TO Drain := Fill.T > T#2s; END_TRANSITION

  STEP Drain:
  END_STEP

  TRANSITION FROM Drain TO Start := I0.2; END_TRANSITION
END_PROGRAM
'''


def clipped(screen):
    """a step is cut with the condition behind it and pasted into the sequence; so are copies and transitions"""
    path = new_file(screen, SEQUENCE)
    editor = Editor(screen, path)
    on_chart(editor)
    editor.click(upon(editor, shape(editor, 'Step Fill')))
    at(editor, 'Step Fill')
    on_chart(editor)
    editor.keys('ctrl+x')
    shape(editor, 'from Start to Drain, condition %IX0.0')
    at(editor, 'Step Start')
    cut = editor.save(path)
    assert 'Fill' not in cut, cut
    # Pasted at its old place the chart is as before; elsewhere the step is connected there.
    editor.keys('ctrl+v')
    at(editor, 'Step Fill')
    assert editor.save(path) == SEQUENCE
    editor.keys('ctrl+z')
    until(lambda: not [name for name in shapes(editor) if 'Fill' in name], 'one step back')
    assert editor.save(path) == cut
    editor.click(upon(editor, shape(editor, 'from Drain to Start')))
    at(editor, 'from Drain to Start')
    on_chart(editor)
    editor.keys('ctrl+v')
    at(editor, 'Step Fill')
    shape(editor, 'from Fill to Start, condition Fill.T > T#2s')
    shape(editor, 'from Drain to Fill, condition %IX0.2')
    editor.shot('chart-pasted')
    check(path)
    # Pasted again: a new name, also in its condition.
    editor.keys('ctrl+c', 'ctrl+v')
    at(editor, 'Step Fill_2')
    shape(editor, 'from Fill to Fill_2, condition Fill.T > T#2s')
    shape(editor, 'from Fill_2 to Start, condition Fill_2.T > T#2s')
    text = editor.save(path)
    check(path)
    # Two steps, with the transitions between and behind them.
    editor.keys('shift+Up', 'shift+Up', 'ctrl+x')
    at(editor, 'Step Drain')
    assert editor.save(path) == cut
    editor.keys('ctrl+v')
    at(editor, 'Step Fill')
    assert editor.save(path) == text
    # Cutting a transition closes the gap; pasting it elsewhere adds a step.
    editor.keys('Down', 'ctrl+x')
    at(editor, 'Step Fill')
    until(lambda: not [name for name in shapes(editor) if 'from Fill to Fill_2' in name], 'the transition to be gone')
    editor.save(path)
    editor.keys('ctrl+v')
    shape(editor, 'from Fill to Fill_2, condition Fill.T > T#2s')
    assert editor.save(path) == text
    editor.keys('Home')
    at(editor, 'Step Start')
    editor.keys('ctrl+v')
    at(editor, 'Step Step1')
    shape(editor, 'from Start to Step1, condition Fill.T > T#2s')
    shape(editor, 'from Step1 to Drain, condition %IX0.0')
    editor.shot('chart-pasted-way')
    editor.save(path)
    check(path)


def lies_in(inner, outer):
    return (outer[0] <= inner[0] and inner[0] + inner[2] <= outer[0] + outer[2] and
            outer[1] <= inner[1] and inner[1] + inner[3] <= outer[1] + outer[3])


def zoomed(screen):
    """the cursor stays in sight when the chart is zoomed by keys and when a step is added"""
    steps = ''.join('  STEP S%d:\n    Q0.0(N);\n  END_STEP\n\n  TRANSITION FROM S%d TO S%d := I0.0; END_TRANSITION\n\n' %
                    (i, i, i + 1) for i in range(1, 19))
    editor = Editor(screen, new_file(screen, 'RUNGBOARD 1\n\nPROGRAM Main SFC\n  INITIAL_STEP S0:\n  END_STEP\n\n'
                                     '  TRANSITION FROM S0 TO S1 := I0.0; END_TRANSITION\n\n' + steps +
                                     '  STEP S19:\n  END_STEP\nEND_PROGRAM\n'))
    on_chart(editor)
    nodes = editor.known()
    scroller = nodes[nodes[chart(editor).parent].parent]

    def seen(text, what):
        until(lambda: lies_in(editor.place(shape(editor, text)), editor.place(scroller)), what)
    for _ in range(10):
        editor.keys('Down', 'Down')
    at(editor, 'Step S10')
    for percent in (125, 156, 195, 244):
        editor.keys('ctrl+plus')
        editor.says('%d %%' % percent)
        seen('Step S10', 'S10 in sight at %d %%' % percent)
    editor.shot('chart-zoomed')
    for _ in range(6):
        editor.keys('ctrl+minus')
    seen('Step S10', 'S10 in sight when all is small')
    editor.keys('ctrl+0')
    editor.says('100 %')
    seen('Step S10', 'S10 in sight at 100 %')
    # One more step below the last one, where there was no room.
    editor.keys('End')
    at(editor, 'Step S19')
    editor.keys('Insert')
    at(editor, 'Step Step1')
    seen('Step Step1', 'the new step')
    editor.keys('ctrl+plus')
    seen('Step Step1', 'the new step, larger')


def long_texts(screen):
    """a comment wider than the window does not widen the window; the next entry opens, too"""
    path = new_file(screen, EMPTY)
    editor = Editor(screen, path)
    on_chart(editor)
    wide = editor.place()[2]
    editor.keys('Home')
    asked(editor, 'semicolon', 'why ' * 120 + 'not')
    on_chart(editor)
    editor.shot('charts-long')
    until(lambda: editor.all('why why', 'label'), 'the place in the status bar')
    assert editor.place()[2] == wide
    editor.keys('ctrl+shift+t')
    editor.opened()
    editor.keys('Escape')
    on_chart(editor)
    text = editor.save(path)
    assert 'why not *)' in text, text
    check(path)
    editor.keys('ctrl+z')
    assert editor.save(path) == EMPTY


bodies.quick = 'editor-gtk/sfc'
if __name__ == '__main__':
    main([by_keyboard, by_pointer, palette, first_key, bodies, clipped, zoomed, simulated, forced, long_texts])
