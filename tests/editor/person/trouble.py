#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""trouble - a failed save is reported, and the work is kept."""
import ctypes
import os
import shutil
import stat
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from desk import EDITOR, Editor, check, lines, main, new_file, sh, until  # noqa: E402

PROJECT = '''RUNGBOARD 1

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start |
END_PROGRAM
'''
PR_CAPBSET_DROP = 24


def mere_mortal():
    """Root may write anywhere; a process without these capabilities may not."""
    for capability in (1, 2, 3):  # DAC_OVERRIDE, DAC_READ_SEARCH, FOWNER
        ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, capability, 0, 0, 0)


def draw(editor):
    editor.to_sheet()
    editor.keys('End')
    editor.entry('Motor')
    until(lambda: len(editor.cells()) == 2, 'the coil')


def saved_well(path):
    check(path)
    assert lines(path, '@print Motor\nStart=0\nStart=1\n') == ['Motor=0', 'Motor=1']


def read_only(screen):
    """a folder without write permission: a banner, the work is kept, and saved later"""
    folder = os.path.join(screen.home, 'locked')
    os.mkdir(folder)
    path = new_file(screen, PROJECT, 'locked/a.rung')
    os.chmod(folder, 0o555)
    editor = Editor(screen, path, before=mere_mortal)
    draw(editor)
    editor.keys('ctrl+s')
    editor.says('ermission denied')
    editor.shot('trouble-read-only')
    editor.logs('system', 'ermission denied')
    editor.shot('trouble-log')
    assert open(path).read() == PROJECT and len(editor.cells()) == 2
    os.chmod(folder, 0o755)
    editor.save(path)
    saved_well(path)


def locked(screen):
    """a read-only file is reported; saving asks once more, saving as another file leaves it; so for a scenario"""
    path = new_file(screen, PROJECT, 'a.rung')
    scenario = new_file(screen, 'scenario One\n', 'a.scn')
    other = os.path.join(screen.home, 'other.rung')
    os.chmod(path, 0o444)
    os.chmod(scenario, 0o444)
    for before in mere_mortal, None:
        editor = Editor(screen, path, before=before)
        editor.says('The file is read-only')
        editor.find('Save as…', 'push button')
        editor.shot('trouble-locked')
        draw(editor)
        editor.keys('ctrl+s')
        editor.find('Save anyway', 'push button')
        editor.shot('trouble-locked-save')
        assert open(path).read() == PROJECT
        editor.give_path(other, 'ctrl+shift+s')
        until(lambda: os.path.exists(other) and 'COIL Motor' in open(other).read(), 'the other file')
        until(lambda: not editor.all('Save anyway'), 'the banner to be gone')
        assert open(path).read() == PROJECT
        editor.finish()
        os.unlink(other)
    editor = Editor(screen, path)
    draw(editor)
    editor.keys('ctrl+w')
    editor.answer('Save')
    editor.click(editor.find('Save anyway', 'push button'))
    until(lambda: 'COIL Motor' in open(path).read(), 'the file to be saved')
    saved_well(path)
    assert stat.S_IMODE(os.stat(path).st_mode) == 0o444
    # It was reported once.
    editor.click(editor.middle(editor.element('Rung 1, NO', 'Start')))
    editor.to_sheet()
    editor.keys('slash')
    assert 'NC Start' in editor.save(path)
    editor.click(editor.find('a.scn', 'label'), count=2)
    editor.into('a.scn')
    editor.keys('ctrl+End')
    editor.type('# mine')
    until(lambda: '# mine' in editor.find('a.scn', 'text').text(), 'what is typed')
    editor.keys('ctrl+s')
    editor.says('is read-only. Save again to overwrite it.')
    assert '# mine' not in open(scenario).read()
    assert '# mine' in editor.save(scenario)


def full_disk(screen):
    """a full disk: a banner, the old file and the work are kept"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    draw(editor)
    sh('prlimit', '--pid', str(editor.process.pid), '--fsize=50:')
    editor.keys('ctrl+s')
    editor.says('File too large')
    assert open(path).read() == PROJECT and len(editor.cells()) == 2
    sh('prlimit', '--pid', str(editor.process.pid), '--fsize=unlimited:')
    editor.save(path)
    saved_well(path)


def vanished(screen):
    """the folder of the file is gone: a banner, the work is kept"""
    os.mkdir(os.path.join(screen.home, 'gone'))
    path = new_file(screen, PROJECT, 'gone/a.rung')
    editor = Editor(screen, path)
    draw(editor)
    shutil.rmtree(os.path.dirname(path))
    editor.keys('ctrl+s')
    editor.says('No such file')
    assert len(editor.cells()) == 2
    os.mkdir(os.path.dirname(path))
    editor.save(path)
    saved_well(path)


def bar(editor):
    """The banner's button, below the one in the window's head, which has a picture."""
    return max(editor.all('Save', 'push button'), key=lambda button: editor.middle(button)[1])


def gone(screen):
    """the file was deleted without an edit: it is reported, and closing asks before the last copy is lost"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 1, 'the contact')
    os.unlink(path)
    editor.keys('ctrl+w')
    editor.answer('Cancel')
    editor.says('The file was deleted or moved')
    editor.shot('trouble-gone')
    editor.keys('ctrl+w')
    editor.answer('Cancel')
    editor.click(bar(editor))
    until(lambda: os.path.exists(path) and open(path).read() == PROJECT, 'the file')
    until(lambda: not editor.all('The file was deleted or moved'), 'the banner to go')
    os.rename(path, path + '~')
    editor.says('The file was deleted or moved')
    os.rename(path + '~', path)
    until(lambda: not editor.all('The file was deleted or moved'), 'the banner to go')
    editor.keys('ctrl+w')
    until(lambda: editor.process.poll() is not None, 'the window to close')


def somebody_else(screen):
    """another program changes the file: it is reported, and reloaded on request"""
    path = new_file(screen, PROJECT)
    editor = Editor(screen, path)
    until(lambda: len(editor.cells()) == 1, 'the contact')
    with open(path, 'w') as file:
        file.write(PROJECT.replace('| NO Start |', '| NO Start | COIL Motor |'))
    editor.says('Another program changed the file')
    editor.shot('trouble-somebody-else')
    editor.logs('system', 'Another program changed the file.')
    editor.click(editor.find('Reload', 'push button'))
    until(lambda: len(editor.cells()) == 2, 'what the other wrote')
    saved_well(path)


def export(editor, what, path):
    """To a path that is typed into the file chooser."""
    editor.give_path(path, lambda: editor.command(what), what)


def toasts(editor, path):
    """Waits for a toast with the path of the written file and no reason."""
    return [node for node in editor.all(path, 'label') if not node.name.startswith(path + ':')]


def refused(editor, what, path, why):
    """A banner with path and reason, no toast, and no new file in the folder."""
    files = os.listdir(os.path.dirname(path))
    export(editor, what, path)
    banner = editor.find(path + ': ', 'label').name
    assert banner.startswith(path + ': ') and why in banner, banner
    assert not toasts(editor, path) and os.listdir(os.path.dirname(path)) == files


def written(editor, what, path):
    """The whole file, a toast, and no banner."""
    export(editor, what, path)
    until(lambda: toasts(editor, path), 'the toast')
    until(lambda: not editor.all('cannot write this file'), 'the banner to be gone')
    with open(path, 'rb') as file:
        text = file.read()
    begin, end = (b'%PDF', b'%%EOF\n') if path.endswith('.pdf') else (b'Scope,Block', b'BOOL,%QX0.0,,,,\r\n')
    assert text.startswith(begin) and text.endswith(end), text[-40:]


EXPORTS = ('Export as PDF', 'a.pdf'), ('Export symbols', 'a.csv')


def export_locked(screen):
    """an export into a folder without write permission: a banner with path and reason, no toast; elsewhere it is written"""
    folder = os.path.join(screen.home, 'locked')
    os.mkdir(folder)
    os.chmod(folder, 0o555)
    editor = Editor(screen, new_file(screen, PROJECT), before=mere_mortal)
    for what, name in EXPORTS:
        editor.to_sheet()
        refused(editor, what, os.path.join(folder, name), 'Permission denied')
        editor.shot('trouble-locked-' + name)
        written(editor, what, os.path.join(screen.home, name))
        editor.shot('trouble-written-' + name)


def export_full(screen):
    """an export to a full disk: a banner with path and reason, no toast, no partial file"""
    folder = os.path.join(screen.home, 'full')
    os.mkdir(folder)
    editor = Editor(screen, new_file(screen, PROJECT))
    for what, name in EXPORTS:
        editor.to_sheet()
        sh('prlimit', '--pid', str(editor.process.pid), '--fsize=100:')
        refused(editor, what, os.path.join(folder, name), 'File too large')
        sh('prlimit', '--pid', str(editor.process.pid), '--fsize=unlimited:')
        written(editor, what, os.path.join(folder, name))


def no_pages(screen):
    """a damaged file is text: print, PDF and the picture of a rung say why they are impossible"""
    editor = Editor(screen, new_file(screen, PROJECT.replace('| NO Start |', '| NOO Start |')))
    editor.find('Text of the program')
    why = 'The file cannot be read as a program'
    editor.keys('ctrl+p')
    editor.says(why)
    editor.shot('trouble-no-pages')
    editor.keys('Escape', 'ctrl+Home', 'Down')
    editor.command('Export as PDF')
    editor.says(why)
    assert len(editor.windows()) == 1
    editor.command('Copy rung as a picture')
    editor.says('Open a sheet first')


def text_closed(screen):
    """the text of a damaged file is closed: the message there opens it again"""
    editor = Editor(screen, new_file(screen, PROJECT.replace('| NO Start |', '| NOO Start |')))
    editor.find('Text of the program')
    editor.keys('ctrl+shift+w')
    editor.find('Nothing is open. Double-click a problem below to open the file as text.', 'label')
    editor.shot('trouble-text-closed')
    editor.click([row for row in editor.all('NOO', 'label')][0], count=2)
    editor.find('Text of the program')
    assert not editor.all('Nothing is open', 'label')


def rendered_locked(screen):
    """--render into a folder without write permission: path and reason are reported, no file is left"""
    folder = os.path.join(screen.home, 'locked')
    os.mkdir(folder)
    os.chmod(folder, 0o555)
    project = new_file(screen, PROJECT)
    for ending in 'svg', 'png', 'pdf':
        path = os.path.join(folder, 'a.' + ending)
        done = subprocess.run([EDITOR, '--render', project, '-o', path], preexec_fn=mere_mortal,
                              capture_output=True, text=True)
        assert done.returncode == 2 and path in done.stderr and 'Permission denied' in done.stderr, done
    assert not os.listdir(folder)


main([read_only, locked, full_disk, vanished, gone, somebody_else, export_locked, export_full, no_pages,
      text_closed, rendered_locked])
