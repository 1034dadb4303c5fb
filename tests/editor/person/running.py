#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""running - the end of a simulation, or why it cannot begin, is reported: errors, faults, closing."""
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import Editor, check, main, new_file, sh, until  # noqa: E402

PROGRAM = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Parts : INT := 12;
  Minutes : INT;
  Rest : INT;
  Done : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Start | COIL Motor |
RUNG "Rate"
  | NO Motor | [ Parts := Parts / Minutes ] |
RUNG "As a box"
  | NO Motor | DIV IN1:=Parts IN2:=Minutes OUT=>Rest | COIL Done |
END_PROGRAM
'''
LOOP = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Jam AT %IX0.1 : BOOL;
  Halt AT %IX0.2 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Alarm AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG "Motor"
  | NO Start | COIL Motor |
RUNG "Alarm"
  | NC Start | NO Jam | COIL Alarm |
RUNG Again
  | NO Jam | JMP Again |
RUNG "The program itself"
  | NO Halt | STOP |
END_PROGRAM
'''
BITS = '''RUNGBOARD 1

VAR
  W : INT := 1;
  In AT %IW0 : WORD;
  Motor AT %QX0.0 : BOOL;
  Lamp AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO W.3 | NO W.%X15 | COIL Motor |
RUNG
  | NC In.9 | COIL Lamp | COIL W.1 |
RUNG
  | [ W.3 AND NOT In.%X9 AND W.%B0 > 2 ] | COIL %QX1.0 |
END_PROGRAM
'''
PLANT = '''RUNGBOARD 1

PROGRAM World LD
RUNG
  | NO Nowhere | COIL %QX0.7 |
END_PROGRAM
'''


BEGUN = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | COIL Motor |
RUNG
  | | |
RUNG
  | NO Nowhere | COIL Nothing |
END_PROGRAM
'''


def errors(screen):
    """a bar counts the errors that keep the program from running, and leads to the first; empty rungs run"""
    editor = Editor(screen, new_file(screen, BEGUN))
    editor.to_sheet()
    editor.click(editor.find('Simulate'))
    editor.find('Cannot simulate: 2 errors', 'label')
    assert not editor.all('SIMULATION'), 'it runs'
    editor.shot('running-errors')
    editor.click(editor.find('Show', 'push button'))
    editor.says('Rung 3 · column A')
    until(lambda: not editor.all('Cannot simulate'), 'the bar to be closed')
    editor.keys('ctrl+m')
    editor.find('Cannot simulate: 2 errors', 'label')
    editor.to_sheet()
    editor.keys('ctrl+End', 'ctrl+Delete')
    until(lambda: not editor.all('Cannot simulate'), 'the bar to go with the errors')
    editor.click(editor.find('Simulate'))
    runs(editor)
    # A new project has one empty rung, and that is no problem.
    editor = Editor(screen)
    editor.says('no problems')
    editor.click(editor.find('Simulate'))
    runs(editor)


def bits(screen):
    """a bit of a number is switched as a BOOL is, by a click and by Space; a forced number stays forced"""
    editor = Editor(screen, new_file(screen, BITS))
    editor.to_sheet()
    editor.click(editor.find('Simulate'))
    runs(editor)
    editor.element('Rung 1, NO', 'W.3, open')
    editor.element('Rung 2, COIL', 'W.1, on')
    editor.click(editor.element('Rung 1, NO', 'W.3'))
    editor.element('Rung 1, NO', 'W.3, closed')
    editor.says('W = 11')
    editor.element('Rung 3', 'W.3 AND', 'TRUE AND NOT FALSE AND 11 > 2')
    editor.keys('Right', 'space')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.says('W = -32757')
    editor.shot('running-bits')
    editor.keys('space')
    editor.element('Rung 1, COIL', 'Motor', ', off')
    editor.click(editor.element('Rung 2, NC', 'In.9'))
    editor.element('Rung 2, COIL', 'Lamp', ', off')
    editor.element('Rung 2, COIL', 'W.1, off')
    editor.keys('ctrl+shift+f')
    editor.says('In is forced')
    editor.keys('space')
    editor.element('Rung 2, COIL', 'Lamp', ', on')
    editor.element('Rung 2, NC', 'In.9', 'forced')
    editor.keys('ctrl+shift+f')
    editor.says('In is released')


def plant(screen):
    """a plant with errors: the message and its place stay; once mended it runs"""
    path = new_file(screen, PROGRAM, 'motor.rung')
    world = new_file(screen, PLANT, 'motor.plant.rung')
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.says('The plant has errors')
    banner = editor.find('The plant has errors', 'label')
    assert 'motor.plant.rung' in banner.name and 'Nowhere' in banner.name, banner.name
    assert 'World, rung 1, row 1, column A' in banner.name, banner.name
    editor.shot('running-plant')
    assert not editor.all('SIMULATION'), 'it runs'
    with open(world, 'w') as file:
        file.write(PLANT.replace('Nowhere', '%IX0.0'))
    editor.keys('ctrl+r')
    editor.says('SIMULATION')
    until(lambda: not editor.all('The plant has errors'), 'the banner to go')


RETAIN = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Lost : INT;
END_VAR

VAR RETAIN
  Kept : INT;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | [ Kept := 7 ] | [ Lost := 7 ] |
END_PROGRAM
'''


def at_the_clock(editor, name):
    """Opens the popover of the clock in the header and moves the focus to a widget of that name."""
    editor.click(editor.find('Simulation settings', 'push button'))
    at = editor.focus_on('Period, ms')
    while name not in at.name:
        editor.keys('Tab')
        at = editor.focus_on(but=at)
    return at


def from_the_clock(editor):
    """Closes it and moves the pointer away: GTK 4.8 sometimes ignores the next click at the place of a popover."""
    editor.keys('Escape')
    sh('xdotool', 'mousemove', *map(str, editor.centre(editor.sheet())))
    until(lambda: not editor.all('Slow motion', 'check box'), 'the popover to be gone')


def runs(editor):
    """Waits until scans go on."""
    until(lambda: editor.all('SIMULATION') and not editor.all('SIMULATION ·'), 'RUN')


def zero(screen):
    """a division by zero is a FAULT with its place and outputs off; Run continues as the board would; also when faults are ignored"""
    path = new_file(screen, PROGRAM)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    editor.find('FAULT: an operation failed, such as a division by zero: Main, rung 2, row 1, column ')
    editor.says('SIMULATION · FAULT')
    # Outputs are off; the failing element is marked.
    editor.element('Rung 1, COIL', 'Motor', ', off')
    editor.element('Rung 2, [:=]', 'ENO is FALSE')
    editor.element('Rung 3, DIV', 'ENO is FALSE')
    editor.shot('running-zero')
    # The scan of the fault, with the values that the board would have.
    editor.keys('alt+Left', 'alt+Right')
    editor.says('PAST')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.keys('alt+End')
    editor.says('SIMULATION · FAULT')
    editor.element('Rung 1, COIL', 'Motor', ', off')
    _, of_the_bar = [node for node in editor.all('Run', 'push button') if node.name == 'Run']
    editor.click(of_the_bar)
    runs(editor)
    until(lambda: not editor.all('FAULT: an operation failed'), 'the bar to be gone')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.shot('running-on')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'closed')))
    until(lambda: not [node for node in editor.all('ENO is FALSE', 'table cell')], 'the marks to go')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    editor.element('Rung 2, [:=]', 'ENO is FALSE')
    runs(editor)
    # The same fault again is not reported again.
    log = editor.logs('system', 'division by zero: Main, rung 2, row 1, column ')
    assert log.count('division by zero') == 1, log
    # A cold start reports it again; it can be switched off.
    switch = at_the_clock(editor, 'FAULT on a failed operation')
    assert switch.has(4)
    editor.keys('space')
    until(lambda: not switch.has(4), 'the switch to be off')
    editor.shot('running-heed')
    from_the_clock(editor)
    at_the_clock(editor, 'Cold start')
    editor.keys('Return')
    from_the_clock(editor)
    editor.says('ENO is FALSE: an operation failed')
    runs(editor)


def safe(screen):
    """before a start, in FAULT and in STOP outputs have the safe values of the I/O map"""
    path = new_file(screen, LOOP)

    def map_says(motor, alarm):
        with open(path.replace('.rung', '.io'), 'w') as file:
            file.write('BOARD "Desk"\n%%IX0.0 sim\n%%IX0.1 sim\n%%IX0.2 sim\n'
                       '%%QX0.0 sim safe=%d\n%%QX0.1 sim safe=%d\n' % (motor, alarm))

    def outputs(motor, alarm):
        editor.element('Rung 1, COIL', 'Motor', motor)
        editor.element('Rung 2, COIL', 'Alarm', alarm)

    map_says(0, 1)
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('ctrl+r')
    runs(editor)
    outputs(', off', ', off')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    outputs(', on', ', off')
    editor.click(editor.middle(editor.element('Rung 3, NO', 'Jam', 'open')))
    editor.says('SIMULATION · FAULT')
    outputs(', off', ', on')
    editor.shot('running-safe')
    editor.click(editor.middle(editor.element('Rung 3, NO', 'Jam')))
    editor.keys('ctrl+r')
    runs(editor)
    outputs(', on', ', off')
    editor.keys('ctrl+shift+r')
    editor.says('SIMULATION · STOP')
    outputs(', off', ', on')
    editor.keys('ctrl+r')
    runs(editor)
    outputs(', on', ', off')
    editor.click(editor.middle(editor.element('Rung 4, NO', 'Halt', 'open')))
    editor.says('SIMULATION · STOP')
    outputs(', off', ', on')
    editor.shot('running-halt')
    # Another map takes effect with the next edit.
    map_says(1, 0)
    editor.keys('ctrl+Home', 'slash')
    editor.element('Rung 1, NC', 'Start')
    outputs(', on', ', off')


def starts(screen):
    """a warm start keeps VAR RETAIN, a cold one nothing"""
    editor = Editor(screen, new_file(screen, RETAIN))
    editor.to_sheet()
    editor.keys('ctrl+r')
    start = editor.element('Rung 1, NO', 'Start', 'open')
    editor.click(editor.middle(start))
    editor.element('Rung 1, [:=]', 'Kept := 7', ', 7')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'closed')))
    for how, kept in ('Warm start', '7'), ('Cold start', '0'):
        at_the_clock(editor, how)
        editor.keys('Return')
        from_the_clock(editor)
        editor.element('Rung 1, [:=]', 'Lost := 7', ', 0')
        editor.element('Rung 1, [:=]', 'Kept := 7', ', ' + kept)
        editor.shot('running-%s' % how.split()[0])


def paces(screen):
    """another period, slow motion, the slider and STOP, by pointer and keys"""
    editor = Editor(screen, new_file(screen, PROGRAM.replace('Minutes : INT', 'Minutes AT %AIW0 : INT := 3')))
    editor.to_sheet()
    editor.keys('ctrl+r')
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start', 'open')))
    editor.element('Rung 1, COIL', 'Motor', ', on')
    scan = lambda: int(re.search(r'scan (\d+)', editor.find('Simulating · ', 'label').name)[1])
    said = re.compile(r'On this machine a scan takes [\d.]+ (µs|ms): (less than )?[\d.]+ % of the period of 10 ms\. '
                      r'The longest took [\d.]+ (µs|ms)\..* late')
    editor.hover(editor.find('Simulating · ', 'label'), lambda: [
        tip for tip in editor.all('On this machine', 'label') if said.match(' '.join(tip.name.split()))])
    editor.shot('running-late')
    editor.click(editor.find('Simulation settings', 'push button'))
    editor.focus_on('Period, ms')
    editor.keys('ctrl+a')
    editor.type('20')
    editor.keys('Tab')
    editor.says('Simulating · 20 ms')
    editor.focus_on('Speed of the board, words/ms')
    editor.keys('Tab')
    switch = editor.focus_on('Slow motion')
    editor.keys('space')
    until(lambda: switch.has(4), 'the switch to be on')
    editor.keys('Tab')
    speed = editor.focus_on(but=switch)
    editor.keys('Home')  # one a second
    editor.shot('running-slow')

    def by():
        """By how many scans the title advances: it is written at most five times a second."""
        before = scan()
        return until(lambda: scan() > before and scan(), 'the next scan') - before
    until(lambda: by() == 1 and by() == 1, 'one scan after the other')
    editor.keys('shift+Tab')
    editor.focus_on('Slow motion', but=speed)
    editor.keys('space')
    until(lambda: not switch.has(4), 'the switch to be off')
    from_the_clock(editor)
    slider = editor.find('Analogue Minutes, %AIW0', 'slider')
    x, y, width, height = editor.place(slider)
    editor.drag((x + width // 2, y + height // 2), (x + width - 4, y + height // 2))
    until(lambda: [node for node in editor.all('Rung 2, [:=]', 'table cell') if node.name.endswith(', 0')],
          'twelve parts in thousands of minutes')
    editor.shot('running-slider')
    editor.keys('ctrl+shift+r')
    editor.says('SIMULATION · STOP')
    editor.element('Rung 1, COIL', 'Motor', ', off')


def closing(screen):
    """the window is closed in RUN: it stops and asks about unsaved work; Cancel keeps it in STOP"""
    path = new_file(screen, PROGRAM.replace('Minutes : INT', 'Minutes : INT := 4'))
    editor = Editor(screen, path)
    editor.to_sheet()
    editor.keys('slash', 'ctrl+r')
    editor.find('•')
    editor.element('Rung 1, NC', 'Start', 'closed')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.keys('ctrl+w')
    editor.answer('Cancel')
    editor.says('SIMULATION · STOP')
    editor.element('Rung 1, COIL', 'Motor', ', off')
    editor.keys('ctrl+r')
    editor.element('Rung 1, COIL', 'Motor', ', on')
    editor.keys('ctrl+w')
    editor.reply('Save')
    until(lambda: editor.process.poll() is not None, 'the end')
    assert editor.process.returncode == 0 and 'NC Start' in open(path).read()
    check(path)


main([errors, bits, plant, zero, safe, starts, paces, closing])
