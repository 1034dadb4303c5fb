#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic_report.t - the report of an import says everything that is lost, and nothing else.
#
# Each element of a random project is in the text of the import or in a line of the report; a
# count in this test, which knows only the files, must agree. A project as ClassicLadder or
# LinuxCNC writes it when nothing was drawn reports nothing. Members open in any order, each of
# them can be missing, and each size can be 0.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;

use lib dirname(abs_path(__FILE__));
use ClassicTest;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} || 'build';
my $ladder = $ENV{LADDER} || "$build/ladder";
my $random = "$build/tests/bin/classic_random";
my $dir = tempdir(CLEANUP => 1);
my $file = "$dir/project.clprj";
my $many = $ENV{REPORT_COUNT} || 60;

# The report and the text of an import.
sub import {
	my ($path) = @_;
	unlink "$dir/out.rung";
	my ($report) = said($ladder, 'import', $path, '-o', "$dir/out.rung");
	return ($report, slurp("$dir/out.rung") // '');
}

sub container {
	my (@member) = @_;
	return join '', "_FILES_CLASSICLADDER\n", (map { "_FILE-$_->[0]\n$_->[1]_/FILE-$_->[0]\n" } @member),
		"_/FILES_CLASSICLADDER\n";
}

# ---- nothing is lost silently ----

# Reads a pin of a block: an import writes such contacts itself, too, so they are not counted.
my %pin = map { $_ => 1 } 10, 11, 15, 20, 25 .. 27, 80, 81;

sub is_counted {
	my ($code, $type) = @_;
	return $code && $code != 9 && $code != 99 && !($code <= 4 && $pin{$type});
}

# Cells of a project: {rung}[row][column] = [code, type].
sub cells {
	my ($text) = @_;
	my ($members) = members($text);
	my %cell;
	for my $name (grep { /^rung_/ } keys %$members) {
		$cell{$name} = [map { [map { [/^\s*(\d+)-\d+-(\d+)/] } split /,/] } grep { /^\d/ } split /\n/, $members->{$name}];
	}
	return \%cell;
}

# Elements of ladders in a text, without those that an import adds.
sub elements {
	my ($text) = @_;
	my $count = 0;
	$text =~ s/^FUNCTION .*?^END_FUNCTION\n//msg;
	$text =~ s/^PROGRAM \S+ SFC .*?^END_PROGRAM\n//msg;
	$text =~ s/^PROGRAM (SystemBits|\S+_Others) .*?^END_PROGRAM\n//msg;
	while ($text =~ /^  \|(.*)$/mg) {
		for my $cell (map { s/ *\^?$//r =~ s/^ *//r } split /\|/, $1) {
			next if $cell =~ /^(---|RET|N[OC] SYS_ALWAYS_ON|(NO|COIL) \w+_Power(_\d+)?|\..*)?$/;
			next if $cell =~ /^(NO|NC|P|N) (T|Mono|TM|C|Reg)\d+\w*\.\w+$/;
			$count++;
		}
	}
	return $count;
}

sub test_elements {
	my $lost = 0;
	for my $seed (1 .. $many) {
		run($random, $seed, "$dir/random", $seed % 4 ? () : ('odd'));
		my $source = slurp("$dir/random.clprj");
		my $cell = cells($source);
		my ($report, $text) = import("$dir/random.clprj");
		my ($in, $out) = (0, elements($text));
		for my $rung (values %$cell) {
			$in += grep { is_counted(@$_) } map { @$_ } @$rung;
		}
		for my $line (grep { /: lost: rung_/ } split /\n/, $report) {
			my ($name) = $line =~ /: lost: (rung_\d+\.csv)/;
			my $at = $line =~ /in row (\d+), column (\d+),/ ? $cell->{$name}[$1 - 1][$2 - 1] : undef;
			$out += $line =~ /element \d+, in (\d+) cells/ ? $1 : !$at || is_counted(@$at) ? 1 : 0;
			$lost++;
		}
		is($out, $in, "seed $seed: each element is written or reported");
		unlike($report, qr/are missing/, "seed $seed: the import counts the same");
		unlike($report, $seed % 4 ? qr/LD325|LD313.*_Power/ : qr/LD325/, "seed $seed: all that it declares is used");
		my ($members) = members($source);
		my $page = $members->{'sequential.csv'};
		for my $what (['S', 'STEP', 'step'], ['T', 'TRANSITION', 'transition']) {
			my $here = () = $text =~ /^  (INITIAL_)?$what->[1]\b/mg;
			my $told = () = $report =~ /: lost: sequential\.csv: (?:\S+: )?(a )?$what->[2] /g;
			my $there = () = $page =~ /^$what->[0]\d/mg;
			is($here + $told, $there, "seed $seed: so is each $what->[2]");
		}
	}
	cmp_ok($lost, '>', 20, 'some elements are lost');
}

# What, members, the line of the report.
my $rung = "#VER=2.0\n1-0-50/0 , 9-0-0/0 , 50-0-60/0\n";
my $sections = "#VER=1.0\n#NAME000=Main\n000,0,-1,0,0,0\n";
my @table = (
	['a rung without an output', [['rung_0.csv', "#VER=2.0\n3-0-0/19 , 1-0-0/39 , 9-0-0/0\n"]],
		qr/:4: lost: rung_0\.csv: Section0: "%B19" in row 1, column 1, leads to no output\n.*"%B39" in row 1, column 2/],
	['an output without power', [['rung_0.csv', "#VER=2.0\n0-0-0/0 , 9-0-0/0 , 52-0-60/0\n"]],
		qr/:4: lost: rung_0\.csv: Section0: "%Q0" in row 1, column 3, never has power/],
	['an operation without power', [['rung_0.csv', "#VER=2.0\n0-0-0/0 , 99-0-0/0 , 99-0-0/0 , 60-0-0/0\n"],
		['arithmetic_expressions.csv', "#VER=2.0\n0000,\@200/3\@:=1\n"]], qr/lost: .*"%W3:=1" in row 1, column 4, never/],
	['a rung of no section', [['rung_0.csv', $rung], ['rung_7.csv', $rung], ['sections.csv', $sections]],
		qr/lost: rung_7\.csv: no section has this rung/],
	['an empty one', [['rung_0.csv', $rung], ['rung_7.csv', "#VER=2.0\n0-0-0/0\n"], ['sections.csv', $sections]], undef],
	['a second symbol', [['rung_0.csv', $rung], ['symbols.csv', "%I0,One,\n%I0,Two,\n"]],
		qr/lost: symbols\.csv: symbol "Two" of %I0 is left out: "One" names it/],
	['the same symbol twice', [['rung_0.csv', $rung], ['symbols.csv', "%I0,One,\n%I0,One,\n"]], undef],
	['a symbol of a pin', [['rung_0.csv', "#VER=2.0\n1-0-10/0 , 50-0-60/0\n"], ['symbols.csv', "%T0.D,Done,\n"]],
		qr/lost: symbols\.csv: symbol "Done" of %T0\.D: pins and times of steps have no names/],
	['a symbol of nothing', [['rung_0.csv', $rung], ['symbols.csv', "%Z0,What,\n"]], qr/symbol "What" of %Z0: there is no such/],
	['a comment without a symbol', [['rung_0.csv', $rung], ['symbols.csv', "%I0,%I0,the button\n"]],
		qr/lost: symbols\.csv: comment "the button" of %I0 is left out: it has no symbol/],
	['a comment of a bit', [['rung_0.csv', "#VER=2.0\n1-0-0/3 , 50-0-60/0\n"], ['symbols.csv', "%B3,%B3,the bit\n"]], undef],
	['a call of nothing', [['rung_0.csv', "#VER=2.0\n9-0-0/0 , 55-0-0/4\n"]], qr/lost: .*a call of subroutine 4/],
	['lines that set up ports', [['rung_0.csv', $rung], ['ioconf.csv', "#VER=1.0\n0,-1,1,890,0,1,0,5\n"]],
		qr/lost: ioconf\.csv: ports of a PC are not set up/],
	['an empty page', [['rung_0.csv', $rung], ['sections.csv', "${sections}001,1,-1,0,0,0\n"]], undef],
	['a transition alone', [['rung_0.csv', $rung], ['sections.csv', "${sections}001,1,-1,0,0,0\n"],
		['sequential.csv', "#VER=1.0\nT0" . ',-1' x 40 . ",0,1,2\nC0,0,50/1\n"]],
		qr/lost: sequential\.csv: .*transition 0: page 0 has no steps/],
	['a page that never runs', [['rung_0.csv', $rung], ['sections.csv', "${sections}001,1,-1,0,0,0\n"],
		['sequential.csv', "#VER=1.0\nS0,0,1,0,1,1\n"]], qr/lost: sections\.csv: .*without an initial step/],
	['a page that no section shows', [['rung_0.csv', $rung], ['sections.csv', $sections],
		['sequential.csv', "#VER=1.0\nS0,1,7,2,1,1\n"]], qr/lost: sequential\.csv: step 7: no section shows page 2/],
	['a modem', [['rung_0.csv', $rung], ['modem_config.txt', "MODEM_USED=1\n"]], qr/lost: modem_config\.txt: the modem is not used/],
);

sub test_table {
	for my $row (@table) {
		my ($what, $members, $line) = @$row;
		spew($file, container(@$members));
		my ($report, $text) = import($file);
		isnt($text, '', "$what: opens") or diag($report);
		if ($line) {
			like($report, $line, "$what: is reported");
		} else {
			like($report, qr/: 0 changed, 0 lost$/, "$what: is not reported");
		}
		unlike($report, qr/are missing/, "$what: the import counts the same");
	}
}

# ---- no news ----

my $blocks = "1,0\n" x 10;
my $free = join(' , ', ('0-0-0/0') x 10) . "\n";
my @linuxcnc = (
	['rung_0.csv', "#VER=2.0\n#LABEL=\n#COMMENT=\n#PREVRUNG=-1\n#NEXTRUNG=-1\n" . $free x 6],
	['modbusioconf.csv', "#VER=1.0\n"], ['timers.csv', $blocks], ['monostables.csv', $blocks],
	['timers_iec.csv', "1,0,0\n" x 10], ['counters.csv', "0\n" x 10],
	['arithmetic_expressions.csv', "#VER=2.0\n"], ['ioconf.csv', "#VER=1.0\n"],
	['com_params.txt', "MODBUS_MASTER_SERIAL_PORT=\nMODBUS_ELEMENT_OFFSET=0\nMODBUS_MAP_COIL_READ=0\n"],
	['sections.csv', "#VER=1.0\n#NAME000=Prog1\n000,0,-1,0,0,0\n"], ['sequential.csv', "#VER=1.0\n"],
	['symbols.csv', "#VER=1.0\n" . join '', map { "%$_,%$_,\n" } qw(I0 I1 Q0 Q1 B0 W0 IW0 QW0 T0 M0 C0 TM0)],
	['general.txt', "PERIODIC_REFRESH=1\n" . join '', map { "SIZE_NBR_$_=10\n" } sizes()],
);
my @upstream = (
	['project_infos.txt', "PROJECT_NAME=\n"], ['general.txt', "PERIODIC_REFRESH=50\n" . join '', map { "SIZE_NBR_$_=50\n" } sizes()],
	(map { [$_, "#VER=2.0\n"] } qw(timers.csv monostables.csv counters.csv timers_iec.csv)),
	(map { [$_, "#VER=1.0\n"] } qw(registers.csv sequential.csv symbols.csv ioconf.csv config_events.csv)),
	['arithmetic_expressions.csv', "#VER=2.0\n"], ['sections.csv', $sections],
	['rung_0.csv', "#VER=3.0\n#LABEL=\n#COMMENT=\n#PREVRUNG=-1\n#NEXTRUNG=-1\n#NBRLINES=8\n" . ("0-0-0/0 , $free" =~ s/\n/ , 0-0-0\/0\n/r) x 8],
	['com_params.txt', "MODBUS_ELEMENT_OFFSET=0\n"], ['modbusioconf.csv', "#VER=2.0\n"],
	['modem_config.txt', "MODEM_USED=0\n"], ['remote_alarms.txt', "GLOBAL_ENABLED=0\n"],
	['spy_vars.csv', "200,200,200,200,200,200,200,200,200,200\n0,1,2,3,4,5,6,7,8,9\n0,0,0\n0,0,0,2,3,0,3,0,0,0\n"],
);

sub sizes {
	return qw(RUNGS BITS WORDS TIMERS MONOSTABLES COUNTERS TIMERS_IEC REGISTERS PHYS_INPUTS PHYS_OUTPUTS
		ARITHM_EXPR SECTIONS SYMBOLS PHYS_WORDS_INPUTS PHYS_WORDS_OUTPUTS);
}

# Neither the report nor a check of the project or of the import says a word.
sub no_news {
	my ($what, $members) = @_;
	spew($file, container(@$members));
	my ($report) = import($file);
	my @line = split /\n/, $report;
	is(join("\n", grep { !/: taken: / } @line), "$file: 0 changed, 0 lost", "$what: nothing to report");
	unlike($report, qr/: taken: .*symbol/, "$what: own names are no symbols");
	for my $path ($file, "$dir/out.rung") {
		my ($said, $status) = said($ladder, 'check', $path);
		is($said, "$path: good\n", "$what: a check finds nothing in " . ($path =~ s/.*\.//r));
	}
}

sub with {
	my ($members, %other) = @_;
	return [map { [$_->[0], $other{ $_->[0] } // $_->[1]] } @$members];
}

sub test_no_news {
	no_news('an empty file', []);
	no_news("LinuxCNC's default", \@linuxcnc);
	no_news("ClassicLadder's default", \@upstream);
	no_news('a contact and a coil in LinuxCNC', with(\@linuxcnc, 'rung_0.csv' => $rung));
	no_news('the same in ClassicLadder', with(\@upstream, 'rung_0.csv' => "#VER=3.0\n1-0-50/0 , 9-0-0/0 , 50-0-60/0\n"));
	# A fault matters only where a block in a rung can show it.
	my $timer = "#VER=3.0\n9-0-0/0 , 99-0-0/0 , 13-0-0/0 , 50-0-60/0\n0-0-0/0 , 99-0-0/0 , 99-0-0/0\n";
	my $mono = $timer =~ s/13-/11-/r;
	no_news('a timer that counts each scan', with(\@upstream, 'rung_0.csv' => $timer,
		'timers_iec.csv' => "#VER=2.0\nTM0,2,5,0\n", 'general.txt' => "PERIODIC_REFRESH=100\n"));
	no_news('a monostable of whole scans', with(\@upstream, 'rung_0.csv' => $mono, 'monostables.csv' => "#VER=2.0\nM0,2,5\n"));
	for my $row (['a timer', $timer, 'timers_iec.csv', "#VER=2.0\nTM0,1,5,0\n", 50, '%TM'],
		     ['a monostable', $mono, 'monostables.csv', "#VER=2.0\nM0,2,5\n", 30, '%M']) {
		my ($what, $cells, $name, $table, $period, $kind) = @$row;
		spew($file, container(@{ with(\@upstream, 'rung_0.csv' => $cells, $name => $table,
			'general.txt' => "PERIODIC_REFRESH=$period\n") }));
		my ($report) = import($file);
		like($report, qr/changed: .*\(\Q$kind\E\)/, "$what that would behave otherwise is reported");
	}
}

# ---- whatever occurs in files ----

sub test_forms {
	for my $key (sizes()) {
		my $general = "PERIODIC_REFRESH=50\n" . join '', map { 'SIZE_NBR_' . $_ . '=' . ($_ eq $key ? 0 : 50) . "\n" } sizes();
		no_news("no $key", with(\@upstream, 'general.txt' => $general));
	}
	no_news('all sizes 0', with(\@upstream, 'general.txt' => "SIZE_REGISTER_LIST=0\nPERIODIC_REFRESH=0\n"
		. join '', map { "SIZE_NBR_$_=0\n" } sizes()));
	no_news('settings without values', with(\@upstream, 'general.txt' => "SIZE_REGISTER_LIST=\nPERIODIC_REFRESH=\n"));
	no_news('an empty member', with(\@linuxcnc, 'counters.csv' => ''));
	no_news('a section without rungs', with(\@upstream, 'sections.csv' => "#VER=1.0\n000,0,-1,0,0,0\n001,0,-1,-1,-1,0\n"));
	for my $members (\@linuxcnc, \@upstream) {
		my $which = $members == \@linuxcnc ? 'LinuxCNC' : 'ClassicLadder';
		for my $left (map { $_->[0] } @$members) {
			no_news("$which without $left", [grep { $_->[0] ne $left } @$members])
				unless $left eq 'rung_0.csv';
		}
		no_news("$which backwards", [reverse @$members]);
	}
	# The order of members changes nothing.
	for my $seed (1 .. 5) {
		run($random, $seed, "$dir/random");
		my ($members, $order) = members(slurp("$dir/random.clprj"));
		my @text;
		for my $list ($order, [reverse @$order], [sort @$order]) {
			spew($file, container(map { [$_, $members->{$_}] } @$list));
			push @text, (import($file))[1];
		}
		is($text[1], $text[0], "seed $seed backwards");
		is($text[2], $text[0], "seed $seed by name");
	}
}

# A function that stands behind a sign is declared, too.
sub test_functions {
	for my $call ('ROL', 'ROR', 'SHL', 'SHR') {
		for my $sign ('', '-', '--', '---', '5*-', '12-') {
			spew($file, container(['rung_0.csv', "#VER=2.0\n1-0-50/0 , 99-0-0/0 , 99-0-0/0 , 60-0-0/0\n"],
				['arithmetic_expressions.csv', "#VER=2.0\n0000,\@200/3\@:=$sign$call(\@200/4\@,2)\n"]));
			unlike(join('', said($ladder, 'check', $file)), qr/ error /, "$sign$call is taken");
		}
	}
}

test_elements();
test_functions();
test_table();
test_no_news();
test_forms();
done_testing();
