#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic_hostile.t - an import of any ClassicLadder project is a rung file without an error, or
# is refused with LD7xx: names that the importer uses itself, numbers of variables that do not
# exist, sections that overlap. It runs only a few scans; tests/classic.t tests scans.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;

use lib dirname(abs_path(__FILE__));
use ClassicTest;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $ladder = $ENV{LADDER} || ($ENV{BUILD} || 'build') . '/ladder';
my $tmp = tempdir(CLEANUP => 1);
my $file = "$tmp/project.clprj";
my $wire = '9-0-0/0';

# A row whose last cell stands in the last column.
sub row {
	my (@cell) = @_;
	my $last = pop @cell;
	return join ' , ', @cell, ($wire) x (11 - @cell), $last;
}
sub operate { return [join ' , ', ($wire) x 9, '99-0-0/0', '99-0-0/0', "60-0-0/$_[0]"] }
sub compare { return [row('99-0-0/0', '99-0-0/0', "20-0-0/$_[0]", '50-0-0/1')] }

sub member { my ($name, @line) = @_; return map { "$_\n" } "_FILE-$name", @line, "_/FILE-$name" }

# What a project is made of: rung (lists of rows), label, chain (each section's rungs alone),
# expression, symbol, section, chart, general, more (members).
sub project {
	my (%of) = @_;
	my @rung = @{ $of{rung} || [] };
	my @expression = @{ $of{expression} || [] };
	my @text = ("_FILES_CLASSICLADDER\n", member('general.txt', 'PERIODIC_REFRESH=50', @{ $of{general} || [] }));
	push @text, member('arithmetic_expressions.csv', '#VER=2.0',
		map { sprintf '%04d,%s', $_, $expression[$_] } 0 .. $#expression);
	for my $i (0 .. $#rung) {
		my ($before, $next) = $of{alone} ? (-1, -1) : ($i - 1, $i < $#rung ? $i + 1 : -1);
		push @text, member("rung_$i.csv", '#VER=3.0', '#LABEL=' . ($of{label} ? $of{label}[$i] : ''),
			'#COMMENT=', "#PREVRUNG=$before", "#NEXTRUNG=$next", @{ $rung[$i] });
	}
	my @section = @{ $of{section} || ['#NAME000=Main', "000,0,-1,0,$#rung,0"] };
	push @text, member('sections.csv', '#VER=1.0', map { s/LAST/$#rung/r } @section);
	push @text, member('sequential.csv', '#VER=1.0', @{ $of{chart} || [] });
	push @text, member('symbols.csv', '#VER=1.0', @{ $of{symbol} || [] });
	push @text, member($_, @{ $of{more}{$_} }) for sort keys %{ $of{more} || {} };
	open my $out, '>:raw', $file or die;
	print $out @text, "_/FILES_CLASSICLADDER\n";
	close $out or die;
}

# No error about the text of the import, which nobody wrote. Constants that can never succeed
# (LD336 to LD338, LD347, LD348) are the project's own.
sub fine {
	my ($what) = @_;
	my ($text, $status) = said($ladder, 'check', $file);
	my @wrong = grep { /error LD[0-6]/ && !/error LD3(?:3[678]|4[78])/ } split /\n/, $text;
	my ($report, $imported) = said($ladder, 'import', $file, '-o', "$tmp/out.rung");
	push @wrong, grep { /error LD[0-6]/ && !/error LD3(?:3[678]|4[78])/ } split /\n/, $report;
	if ($imported == 0 && !@wrong) {
		my ($own) = said($ladder, 'check', "$tmp/out.rung");
		push @wrong, grep { /error LD/ && !/error LD3(?:3[678]|4[78])/ } split /\n/, $own;
	}
	push @wrong, grep { /are missing/ } split /\n/, $report;
	push @wrong, "ended by signal $status" if $status >= 128;
	ok(!@wrong, $what) or diag(join "\n", @wrong[0 .. ($#wrong < 3 ? $#wrong : 3)]);
	return ($text, $report);
}

sub refused {
	my ($what, $code) = @_;
	my ($text) = fine($what);
	like($text, qr/error $code/, "$what: $code");
}

# ---- names ----

my $links = ',-1' x 9;
my $drawn = ',-1' x 20;
sub chart_of {
	my ($page, $index, $from, $to) = @_;
	my ($a, $b) = ($index, $index + 1);
	return ("S$a,1,$from,$page,1,1", "S$b,0,$to,$page,1,3",
		"T$a,$b$links,$a$links$drawn,$page,1,2", "T$b,$a$links,$b$links$drawn,$page,1,4",
		"C$a,0,0/3", "C$b,0,30/$to");
}

# Every element, so that the importer uses all names that it has.
my @everything = (
	[row('1-0-70/0', '50-0-0/1')], (map { operate($_) } 0 .. 4), compare(5), compare(6),
	[row('99-0-0/0', '13-0-0/0', '50-0-0/2'), '99-0-0/0 , 99-0-0/0'],
	[row('99-0-0/0', '13-0-0/1', '50-0-0/2'), '99-0-0/0 , 99-0-0/0'],
	[row('1-0-0/1', $wire, '99-0-0/0', '12-0-0/0', '1-0-25/0', '50-0-0/2'),
		"$wire , $wire , 99-0-0/0 , 99-0-0/0",
		join(' , ', $wire, $wire, '99-0-0/0', '99-0-0/0', ($wire) x 7, '50-0-0/9'),
		"1-0-0/5 , $wire , 99-0-0/0 , 99-0-0/0"],
	[row('99-0-0/0', '10-0-0/0', '50-0-0/2'), '99-0-0/0 , 99-0-0/0'],
	[row('99-0-0/0', '11-0-0/0', '50-0-0/2'), '99-0-0/0 , 99-0-0/0'],
	[row('99-0-0/0', '14-0-0/0', '50-0-0/2'), '99-0-0/0 , 99-0-0/0', '99-0-0/0 , 99-0-0/0'],
	[row('1-0-0/3', '54-0-0/0')], [row('1-0-0/3', '55-0-0/0')],
);
my @expressions = ('@200/0@:=@200/0[200/1]@+@220/1@',
	'@200/0@:=@200/1@*@200/2@+@200/1@/@200/2@-SHL(@200/1@,2)+@200/1@%@200/3@',
	'@200/4@:=@200/1@&3|@200/5@^7', '@200/4@:=SHR(@200/1@,1)+ROL(@200/1@,1)-ROR(@200/1@,1)',
	'@200/4@:=POW(@200/1@,2)', '@270/0[200/1]@>2', '@290/0@=3');
my @chart = (chart_of(0, 0, 1, 15), chart_of(1, 2, 3, 16));
my @sections = ('#NAME000=Main', '#NAME001=Chart', '#NAME002=Other', '#NAME003=Sub', '000,0,-1,0,LAST,0',
	'001,1,-1,0,0,0', '002,1,-1,0,0,1', '003,0,0,0,0,0');

# Bits from %B100 on have the symbols.
sub everything {
	my ($symbols, %more) = @_;
	project(rung => [@everything, map { [row("1-0-0/$_", "50-0-0/$_")] } map { 100 + $_ } 0 .. $#$symbols],
		expression => \@expressions, chart => \@chart, section => \@sections,
		symbol => [(map { "%B" . (100 + $_) . ",$symbols->[$_],c" } 0 .. $#$symbols), @{ $more{symbol} || [] }],
		%more{ grep { $_ ne 'symbol' } keys %more });
}

sub words_of {
	my %word = map { $_ => 1 } map { /[A-Za-z_][A-Za-z0-9_]*/g } @_;
	return sort keys %word;
}

sub test_names {
	everything([]);
	my ($text) = fine('every element');
	my @said;
	for my $faithful ([], ['--faithful']) {
		said($ladder, 'import', @$faithful, $file, '-o', "$tmp/said.rung");
		push @said, words_of(slurp("$tmp/said.rung"));
	}
	my ($catalogue) = said($ladder, 'words');
	my @word = words_of(@said, $catalogue, qw(Words InWords OutWords SysWords x3 X3_a T0_a Rung1_Power Main_1));
	cmp_ok(scalar @word, '>', 400, 'names that the importer or the language uses');
	while (my @part = splice @word, 0, 120) {
		everything(\@part);
		fine("symbols $part[0] to $part[-1]");
		my @what = qw(%T %TM %M %C %R %X %W %IW %QW %Q %I %S %SW %QLED);
		everything([], symbol => [map { "$what[$_ % @what]" . int($_ / @what) . ",$part[$_],c" } 0 .. $#part]);
		fine('the same, of blocks, steps and words');
		my @rung = map { [row('1-0-0/3', "50-0-0/$_")] } 0 .. $#part;
		project(rung => \@rung, alone => 1, section => [
			(map { sprintf '#NAME%03d=%s', $_, $part[$_] } 0 .. $#part),
			(map { sprintf '%03d,0,%d,%d,%d,0', $_, $_ % 2 ? -1 : $_, $_, $_ } 0 .. $#part)]);
		fine('the same, of sections');
		project(rung => [@rung, map { [row('1-0-0/3', "54-0-0/$_")] } 0 .. $#rung],
			label => [@part, ('') x @rung]);
		fine('the same, as labels');
	}
	my @odd = ('"', '*)', '(*', 'a b', "\xc3\xa9", "\xe9", "\x01", 'a' x 250, "\xc3\xa9" x 125, '1a', '_', '%B1', 'a.b',
		'//', '$', "'", "\xe6\x97\xa5");
	everything([@odd, map { $_ . '_2' } @odd], symbol => [map { "%TM0,$_,$_" } @odd]);
	fine('symbols that are no names');
	everything([('same') x 300]);
	fine('one symbol for everything');
	for my $odd (@odd) {
		project(rung => \@everything, expression => \@expressions, chart => \@chart,
			section => [(map { s/Main|Chart/$odd/r } @sections)], label => [($odd) x @everything]);
		fine('a section and labels that are no names');
	}
}

# A bit whose symbol is the name of another thing is still that bit.
sub test_they_work {
	project(rung => [[row('1-0-70/4', '50-0-60/0')], [row('1-0-0/3', '50-0-60/1')], [row('1-0-30/1', '50-0-60/2')],
			[row('1-0-0/4', '50-0-60/3')], [row('1-0-70/0', '50-0-60/4')]],
		chart => [chart_of(0, 0, 1, 15)], section => [@sections[0, 1, 4, 5]],
		symbol => ['%S0,Flash,x', '%B3,X1,y', '%B4,Step1,z', '%X1,A,b']);
	open my $script, '>', "$tmp/script" or die;
	print $script "\@print %Q1 %Q2 %Q3 %Q4 %X1.A %X15.A\n.\n%B4=1\n";
	close $script;
	my ($text) = said($ladder, 'trace', '--changes', $file, "$tmp/script");
	is(join('', grep { /^\d/ } map { "$_\n" } split /\n/, $text), "1 t=50 %Q4=1 %X1.A=1\n2 t=100 %Q2=1 %Q3=1\n",
		'steps and bits are found by their old names');
}

# ---- numbers ----

my @types = (0, 10, 11, 15, 20, 25, 26, 27, 30, 50, 60, 65, 70, 75, 80, 81, 200, 220, 230, 231, 240, 241, 250, 251, 260,
	261, 270, 280, 290, 300, 301, 302, 310, 5, 999);
my @numbers = (0, 1, 15, 16, 255, 256, 2047, 2048, 5000, 9999);

sub test_numbers {
	for my $type (@types) {
		for my $steps (0, 1) {
			my (@rung, @expression);
			for my $number (@numbers) {
				my $variable = "$type/$number";
				push @rung, map { [row(@$_)] } ["1-0-$variable", '50-0-0/1'], ["3-0-$variable", '51-0-0/1'],
					['1-0-0/1', "50-0-$variable"], ['2-0-0/1', "52-0-$variable"],
					["1-0-$variable\[200/4]", '50-0-0/1'], ["1-0-0/1[$variable]", "50-0-0/1[$variable]"],
					['1-0-0/1', "53-0-$variable\[200/4]"];
				push @expression, "\@200/1\@:=\@$variable\@+1", "\@$variable\@:=\@200/1\@+1",
					"\@200/2\@:=\@$variable\[200/4]\@", "\@200/2[$variable]\@:=3", "\@$variable\[200/3]\@:=\@200/3\@";
			}
			push @rung, map { operate($_) } 0 .. $#expression;
			my %what = (rung => \@rung, expression => \@expression,
				chart => $steps ? [chart_of(0, 0, 1, 15)] : [], section => [@sections[0, 1, 4, 5]]);
			project(%what);
			fine("variables of type $type" . ($steps ? ', with steps' : ''));
			next if $steps;
			project(%what, more => { 'com_params.txt' => ['MODBUS_MAP_COIL_READ=0'] });
			fine("variables of type $type in LinuxCNC");
		}
		my @chart = map { my $i = $_; map { s{C0,0,0/3}{C0,0,$type/$numbers[$i]}r } chart_of(0, 0, 1, 15) } 0;
		project(rung => [[row('1-0-0/1', '50-0-0/1')]], chart => \@chart, section => [@sections[0, 1, 4, 5]]);
		fine("a condition of type $type");
	}
	project(rung => [[row('1-0-0/1', '50-0-50/3')], [row('1-0-70/300', '50-0-60/1')]]);
	my (undef, $report) = fine('variables that do not exist');
	like($report, qr/:14: lost: rung_0\.csv: .*%IX0\.3 cannot be written by a program/, 'a line of the report with its place');
	like($report, qr/lost: rung_1\.csv: .*type 70, number 300/, 'a system bit that does not exist');
	# Each line names the rung in the import; none if it became no rung.
	my @good = [row('1-0-50/0', '50-0-60/0')];
	project(rung => [@good, [row('1-0-70/300', '9-0-0/0')], @good, [row('1-0-70/301', '50-0-60/1')]]);
	(undef, $report) = fine('rungs in the report');
	like($report, qr/: lost: rung_1\.csv: Main: variable of type 70, number 300/, 'a rung that became none');
	like($report, qr/: lost: rung_3\.csv: Main rung 3: variable of type 70, number 301/, 'the rung that it became');
}

# Arrays have the sizes of general.txt.
sub test_sizes {
	my @assign = ('@200/10[200/4]@:=@200/1@+1', '@280/2[200/4]@:=@270/1[200/3]@+1');
	for my $general ('SIZE_NBR_WORDS=5000', 'SIZE_NBR_WORDS=-1', 'SIZE_NBR_WORDS=99999999999999999999',
		'SIZE_NBR_WORDS=x', 'SIZE_NBR_PHYS_WORDS_INPUTS=2048', 'SIZE_NBR_PHYS_WORDS_OUTPUTS=9999') {
		project(rung => [operate(0), operate(1)], expression => \@assign, general => [$general]);
		fine($general);
	}
	project(rung => [operate(0)], expression => \@assign, general => ['SIZE_NBR_WORDS=5000']);
	open my $script, '>', "$tmp/script" or die;
	print $script "\@print %W4999\n%W1=41 %W4=4989\n%W4=4990\n";
	close $script;
	my ($text) = said($ladder, 'trace', '--changes', $file, "$tmp/script");
	like($text, qr/^1 t=50 %W4999=42$/m, 'the last word of 5000');
}

# ---- expressions ----

sub test_expressions {
	my @text = ('(' x 39 . '1' . ')' x 39, '(' x 60 . '1' . ')' x 60, '!' x 38 . '1', '-' x 39 . '@200/1@',
		(map { my $op = $_; join $op, ('@200/1@') x 100 } '+', '*', '&', '/', '|'), '--5', '-(5)', '---(5+3)',
		'ABS(-2147483648)', '-2147483648', '99999999999999999999', '$FFFFFFFF', "'ABCDE'", "''", '1/0', '1%0',
		'5/-1', '@200/1@%-1', 'SHL(1,40)', 'SHL(@200/1@,-1)', 'POW(2,31)', '1--@200/1@', '1*-3', '@200/1[0/1]@',
		'@200/1[261/1]@', '@0/1@-@0/2@', '5&3', 'ABS(1,2)', 'MINI(1)', 'AVG()', '@200/1@@200/2@', '', '#', '%', '=');
	for my $text (@text) {
		project(rung => [operate(0), compare(1)], expression => ["\@200/0\@:=$text", "$text>3"]);
		fine('expression ' . substr($text, 0, 40));
	}
}

# ---- sections ----

sub test_sections {
	my @rung = map { [row('1-0-0/1', "50-0-0/$_")] } 0 .. 3;
	my %with = (rung => \@rung, chart => [chart_of(0, 0, 1, 15)]);
	project(%with, section => ['#NAME000=A', '#NAME001=B', '#NAME002=C', '000,0,-1,0,3,0', '001,1,-1,0,0,0', '002,1,-1,0,0,0']);
	my (undef, $report) = fine('two sections that show one page');
	like($report, qr/changed: sections\.csv: .*shows page 0 once more/, 'a line of the report');
	project(%with, section => ['000,0,-1,0,3,0', '001,1,3,0,0,0']);
	fine('a page as a subroutine');
	project(%with, section => ['000,0,-1,0,3,0', '001,1,-1,0,0,7']);
	fine('a page without steps');
	project(section => ['000,1,-1,0,0,0']);
	fine('a page without steps, and nothing else');
	project(%with, section => ['000,1,-1,0,0,0']);
	fine('a page alone');
	project(%with, section => ['000,0,0,0,3,0']);
	fine('a subroutine alone');
	project(%with, section => ['000,0,-1,0,3,0', '001,0,-1,1,2,0']);
	fine('sections that overlap');
	project(rung => \@rung, section => ['000,0,0,0,1,0', '001,0,0,2,3,0']);
	fine('two subroutines with one number');
	for my $depth (13, 14, 15, 60) {
		project(alone => 1, rung => [map { [row('1-0-0/1', "55-0-0/$_")] } 0 .. $depth],
			section => ['000,0,-1,0,0,0', map { sprintf '%03d,0,%d,%d,%d,0', $_ + 1, $_, $_ + 1, $_ + 1 } 0 .. $depth - 1]);
		$depth < 14 ? fine("$depth subroutines that call one another") :
			      refused("$depth subroutines that call one another", 'LD715');
	}
	project(rung => [[row('1-0-0/1', '55-0-0/0')]], section => ['000,0,0,0,0,0']);
	refused('a subroutine that calls itself', 'LD715');
	# Each section calls the next one from both of its rungs: as many ways as bits of a word.
	project(alone => 1, rung => [map { my $to = $_; [(row('1-0-0/1', "55-0-0/$to")) x 8] } 0 .. 12],
		section => ['000,0,-1,0,0,0', map { sprintf '%03d,0,%d,%d,%d,0', $_ + 1, $_, $_ + 1, $_ + 1 } 0 .. 11]);
	fine('8 to the power of 12 ways to call');
}

# ---- time ----

# Seconds of processor time for an import.
sub seconds_of {
	my ($rungs) = @_;
	project(rung => [map { my $i = $_; [row("1-0-50/$i", "1-0-0/$i", "50-0-0/" . (($i + 1) % 9990)),
			(map { row('1-0-0/' . (($i * 7 + $_) % 9990), '50-0-60/' . ($i % 4000)) } 1 .. 3),
			row('1-0-0/1', '54-0-0/' . (($i * 31) % $rungs))] } 0 .. $rungs - 1],
		symbol => [map { "%B$_,Bit of $_,c" } 0 .. $rungs - 1]);
	my @before = times;
	my ($text, $status) = said($ladder, 'import', $file, '-o', "$tmp/out.rung");
	my @after = times;
	is($status, 0, "$rungs rungs") or diag(substr $text, 0, 300);
	return $after[2] - $before[2];
}

sub test_time {
	my $small = seconds_of(1200);
	my $large = seconds_of(9600);
	# Quadratic time would be 64 times as long.
	cmp_ok($large, '<', 24 * $small + 0.3, sprintf 'eight times as many rungs: %.2f s, %.2f s', $small, $large);
}

test_names();
test_they_work();
test_numbers();
test_sizes();
test_expressions();
test_sections();
test_time();
done_testing();
