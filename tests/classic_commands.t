#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic_commands.t - every command of `ladder` with a ClassicLadder project in each of its
# forms. Commands that read accept it, with the old names of variables; commands that write, or
# need the text of a rung file, refuse it, say what to do, and leave it unchanged. A command
# that is not in the table fails. tests/classic.t tests scans.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use IO::Compress::Gzip qw(gzip);
use Test::More;

use lib dirname(abs_path(__FILE__));
use ClassicTest;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = abs_path($ENV{BUILD} || 'build');
my $ladder = abs_path($ENV{LADDER} || "$build/ladder");
my $commands = slurp('runtime/ladder/commands.def');
my $tmp = tempdir(CLEANUP => 1);
chdir $tmp or die;

my $w = '9-0-0/0';
my $none = ',-1' x 9;
my $drawn = ',-1' x 20;
sub row { my (@cell) = @_; my $last = pop @cell; return join ' , ', @cell, ($w) x (11 - @cell), $last }
my %member = (
	'general.txt' => "PERIODIC_REFRESH=40\n",
	'timers_iec.csv' => "#VER=2.0\nTM0,1,2,0\n",
	'arithmetic_expressions.csv' => "#VER=2.0\n0000,\@200/5\@:=\@200/5\@+\@261/0\@+\@200/7\@\n",
	'rung_0.csv' => "#VER=3.0\n#LABEL=Seal\n#COMMENT=\n#PREVRUNG=-1\n#NEXTRUNG=1\n"
		. row('1-0-50/0', '2-0-50/1', '50-0-60/0') . "\n1-0-60/0 , 0-1-0/0\n",
	'rung_1.csv' => "#VER=3.0\n#LABEL=\n#COMMENT=\n#PREVRUNG=0\n#NEXTRUNG=2\n"
		. row('1-0-60/0', $w, '99-0-0/0', '13-0-0/0', '50-0-60/1') . "\n$w , $w , 99-0-0/0 , 99-0-0/0\n",
	'rung_2.csv' => "#VER=3.0\n#LABEL=\n#COMMENT=\n#PREVRUNG=1\n#NEXTRUNG=3\n"
		. join(' , ', ($w) x 9, '99-0-0/0', '99-0-0/0', '60-0-0/0') . "\n",
	'rung_3.csv' => "#VER=3.0\n#LABEL=\n#COMMENT=\n#PREVRUNG=2\n#NEXTRUNG=-1\n" . row('1-0-30/2', '50-0-0/3') . "\n",
	'sections.csv' => "#VER=1.0\n#NAME000=Main\n#NAME001=Chart\n000,0,-1,0,3,0\n001,1,-1,0,0,0\n",
	'sequential.csv' => "#VER=1.0\nS0,1,1,0,1,1\nS1,0,2,0,1,3\nT0,1$none,0$none$drawn,0,1,2\n"
		. "T1,0$none,1$none$drawn,0,1,4\nC0,0,60/1\nC1,0,50/1\n",
	'symbols.csv' => "#VER=1.0\n%I0,Start,the button\n%TM0,Pause,x\n%Q0,Motor,\n%W7,Seven,\n",
);

my $text = join '', "_FILES_CLASSICLADDER\n", (map { "_FILE-$_\n$member{$_}_/FILE-$_\n" } sort keys %member),
	"_/FILES_CLASSICLADDER\n";
spew('pump.clprj', $text);
spew('old.clp', $text);
gzip \$text => 'packed.clprjz' or die;
mkdir 'folder' or die;
spew("folder/$_", $member{$_}) for keys %member;
spew("$_.scn", "scenario \"runs\"\n  at 100ms %I0 = 1\n  within 40ms expect %Q0\n"
	. "  within 3s expect %Q1, %TM0.V = 2, %X2.A\n") for 'pump', 'old', 'packed';
spew('script', "\@print %Q0..1 %TM0.V %X2.A Motor\n%I0=1\n. x60\n");
spew('map', "BOARD \"none\"\n");

my $refused = qr/error LD717: .*ladder import/;
# A command, its arguments, status and output. FILE is the project. `undef`: the command takes
# no program.
my @table = (
	['check', ['FILE'], 0, qr{^FILE(?:/symbols\.csv)?:\d+: warning LD312: "Seven".*\nFILE: good, 1 warning$}],
	['check', ['--json', 'FILE'], 0, qr/"LD312"/],
	['complete', ['FILE', 3, 2], 1, $refused],
	['fmt', ['FILE'], 1, $refused],
	['fmt', ['--check', 'FILE'], 1, $refused],
	['show', ['FILE', 'Seal'], 0, qr/ Start .* Motor /],
	['show', ['FILE', '--after', 'script'], 0, qr/PROGRAM Main/],
	['il', ['FILE'], 0, qr/^RUNGBOARD 1\n(?s:.*)INTERVAL := T#40ms/m],
	['code', ['FILE'], 0, qr/^identity .*\n(?s:.*)every 40 ms/m],
	['export', ['--as', 'ld', 'FILE'], 1, qr/^FILE.*: Chart: error LD460/m],
	['export', ['--as', 'classicladder', 'FILE'], 0, qr/_FILES_CLASSICLADDER\n(?s:.*)%I0,Start,/],
	['import', ['FILE'], 0, qr/FILE(?::\d+)?: taken: symbols\.csv: .*"Pause" of %TM0 becomes TM0_Pause/],
	['build', ['FILE', '-o', 'out.rungc'], 0, qr/LD312/],
	['run', ['FILE', '--scans', 2, '--plain', '--set', 'Start=1'], 0, qr/^1 t=40 .*Motor=1/m],
	['run', ['FILE', '--scans', 2, '--plain', '--set', '%I0=1'], 0, qr/^1 t=40 .*Motor=1/m],
	['trace', ['FILE', 'script', '--changes'], 0, qr/^1 t=40 %Q0=1 Motor=1\n25 t=1000 %TM0\.V=1\n50 t=2000 %TM0\.V=2\n51 t=2040 %Q1=1 %X2\.A=1$/m],
	['why', ['FILE', 'script', '%Q1'], 0, qr/has power: Main rung 2.*\n  Motor is TRUE/],
	['why', ['FILE', 'script', 'Motor'], 0, qr/^Motor has power/m],
	['why', ['FILE', 'script', '%B3'], 0, qr/has power: Main rung 4/],
	['test', ['FILE'], 0, qr/^ok 1 - \w+\.scn: runs\n1\.\.1$/m],
	['bench', ['FILE', '--scans', 10], 0, qr/^rungs /m],
	['words', undef],
	['xref', ['FILE', '%Q0'], 0, qr/^Motor\tdeclared\tFILE:\d+\nMotor\tcoil\tFILE:\d+\tMain rung 1 \(1,3\)$/m],
	['diff', ['FILE', 'pump.clprj'], 'any', qr/^(?:project: title .* -> pump\.clprj\n)?(?!.*variable)/],
	['io', undef],
	['push', ['FILE', 'nowhere', 'a@b'], 2, qr/nowhere/],
	['board', ['unix:nowhere', 'download', 'FILE', 'nowhere'], 2, qr/nowhere/],
	['replay', ['FILE'], 'any', qr{error LD860: not a record|error LD005: not a regular file}],
	['boards', undef],
	['help', undef],
);

sub test_table {
	my %known = map { $_->[0] => 1 } @table;
	my @command = $commands =~ /^COMMAND\((\w+),/mg;
	cmp_ok(scalar @command, '>', 15, 'commands are found');
	ok($known{$_}, "$_ is in the table") for @command;
}

sub state_of { return join "\n", map { $_ . ': ' . (slurp($_) // '?') } sort glob('*.cl* folder/*') }

sub test_form {
	my ($file) = @_;
	my $before = state_of();
	for my $row (@table) {
		my ($command, $argument, $status, $like) = @$row;
		next unless $argument;
		# A folder has no scenario beside it.
		next if $command eq 'test' && -d $file;
		my @argument = map { s/^FILE$/$file/r } @$argument;
		my ($text, $got) = said($ladder, $command, @argument);
		$text =~ s/^\Q$file\E/FILE/mg;
		$text =~ s/\t\Q$file\E/\tFILE/g;
		my $name = "ladder $command @argument";
		like($text, $like, $name);
		is($got, $status, "$name: status") if $status ne 'any';
	}
	is(state_of(), $before, "$file: is unchanged");
}

# Messages have lines of the project.
sub test_places {
	my ($text) = said($ladder, 'check', 'pump.clprj');
	my ($line) = $text =~ /^pump\.clprj:(\d+): warning LD312/;
	is((split /\n/, slurp('pump.clprj'))[$line - 1], '%W7,Seven,', 'a warning stands where the symbol stands');
	($text) = said($ladder, 'check', 'folder');
	($line) = $text =~ m{^folder/symbols\.csv:(\d+): warning LD312};
	is((split /\n/, $member{'symbols.csv'})[$line - 1], '%W7,Seven,', 'the same in a folder');
	($text) = said($ladder, 'xref', 'pump.clprj', 'Motor');
	($line) = $text =~ /^Motor\tcoil\tpump\.clprj:(\d+)/m;
	is((split /\n/, slurp('pump.clprj'))[$line - 1], '#VER=3.0', 'a coil where its rung begins');
}

# An image has the period and names of the project.
sub test_image {
	my ($text) = said($ladder, 'trace', 'out.rungc', 'script', '--changes');
	like($text, qr/^1 t=40 %Q0=1 Motor=1$/m, 'the image has the period of the project');
	said($ladder, 'import', 'pump.clprj', '-o', 'imported.rung');
	my ($rungs) = slurp('imported.rung') =~ /^PROGRAM Main LD\n(.*?)^END_PROGRAM/ms;
	is($rungs, <<'END', 'rungs are drawn as they were, without columns of wires');
RUNG Seal
  | NO Start  | NC %IX0.1 | COIL Motor |
  | NO Motor ^|
RUNG
  | NO Motor | CL_TON TM0_Pause DT:=SYS_CYCLE | COIL %QX0.1 |
RUNG
  | --- | [ Word5 := Sum(Word5, TM0_Pause.V) + Seven ] |
RUNG
  | NO X2 | COIL Bit3 |
END
	said($ladder, 'build', 'imported.rung', '-o', 'imported.rungc');
	is(slurp('imported.rungc') eq slurp('out.rungc') ? 1 : 0, 1, 'the image is that of the imported file');
}

# ladderd does not import.
sub test_ladderd {
	for my $file ('pump.clprj', 'packed.clprjz') {
		my ($text, $status) = said("$build/ladderd", '--io', 'map', $file);
		like($text, $refused, "ladderd $file");
		isnt($status, 0, "ladderd $file: status");
	}
}

test_table();
test_form($_) for 'old.clp', 'packed.clprjz', 'folder', 'pump.clprj';
test_places();
test_image();
test_ladderd();
done_testing();
