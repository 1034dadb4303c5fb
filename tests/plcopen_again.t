#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# plcopen_again.t - every sample is exported as PLCopen XML, imported, and exported again: the second XML is the
# first, and the rung file is the sample itself. Without the text that an export puts beside the drawing, as other
# tools see it, the import does the same as the sample, but for what the report of the export calls lost.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;
use PlcopenShape;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

spew('probe.xml', '<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types/></project>');
plan skip_all => 'built without libxml2' if `$ladder check probe.xml 2>&1` =~ /LD040/;

# The XML without the text beside the drawing.
sub bare { return $_[0] =~ s{  <addData>\n    <data name="urn:rungboard:text".*?</addData>\n}{}sr }

# Random inputs, and what is printed: all elementary variables of the project and of its programs.
sub script {
	my ($text, $seed) = @_;
	my (%input, @print);
	my $pou = '';
	for my $line (split /\n/, $text) {
		$pou = $2 // '' if $line =~ /^(PROGRAM|FUNCTION|FUNCTION_BLOCK|SUBROUTINE)\s+(\w+)/ ;
		$pou = '?' if $line =~ /^(?:FUNCTION|FUNCTION_BLOCK|SUBROUTINE|TYPE)\b/;
		$pou = '' if $line =~ /^(?:END_|CONFIGURATION)/ && $line !~ /^END_VAR/;
		next unless $line =~ /^\s+(\w+)(?:\s+AT\s+(%\S+))?\s*:\s*(BOOL|S?INT|DINT|U(?:S|D)?INT|BYTE|D?WORD|TIME|REAL)\b/;
		my ($name, $at, $type) = ($1, $2 // '', $3);
		next if $pou eq '?';
		$input{$name} = $type if $at =~ /^%I/ && $pou eq '';
		push @print, $pou ? "$pou.$name" : $name if $at !~ /^%I/;
	}
	srand $seed;
	my $script = '@print ' . join(' ', @print, '%QB0', '%MB0') . "\n";
	my @names = sort keys %input;
	for (1 .. 150) {
		my @set = !@names ? () : map { my $n = $names[rand @names]; $input{$n} eq 'BOOL' ? "$n=" . int(rand 2) : $input{$n} =~ /REAL/ ? sprintf('%s=%.1f', $n, rand 100) : "$n=" . int(rand 100) } 0 .. rand 3;
		@set = map { sprintf '%%IX%d.%d=%d', rand 2, rand 8, rand 2 } 0 .. rand 3 if !@names;
		$script .= join(' ', @set) . "\n";
		$script .= '. x' . int(1 + rand 40) . "\n" if rand() < 0.3;
	}
	return $script;
}

sub traced {
	my ($file, $option) = @_;
	my $text = `$ladder trace $option '$file' script 2>trouble`;
	return $text eq '' ? slurp('trouble') : $text;
}
sub first_difference {
	my @a = split /\n/, $_[0];
	my @b = split /\n/, $_[1];
	for (0 .. ($#a > $#b ? $#a : $#b)) {
		return "was: " . ($a[$_] // '-') . "\nis:  " . ($b[$_] // '-') if ($a[$_] // '') ne ($b[$_] // '');
	}
	return '';
}

# What the drawing of these cannot say, so that it does something else without the text beside it.
my %differs = (mixer => 'subroutines', 'mixing-tank' => 'CONTROL', 'press-two-hand' => 'CONTROL',
	'traffic-crossing' => 'CONTROL', 'washing-machine' => 'CONTROL', 'cement-plant' => 'subroutines');

my @samples = (sort(glob "$tests/../ladders/*.rung"), map { "$tests/../ladders/$_/$_.rung" } qw(boiler-room cement-plant));
for my $sample (@samples) {
	my $name = basename($sample, '.rung');
	my $single = dirname($sample) =~ /ladders$/;
	my $said = `$ladder export --as plcopen '$sample' -o first.xml 2>&1`;
	is($?, 0, "$name: exported") or diag($said), next;
	my $xml = slurp('first.xml');
	is(PlcopenShape::wrong($xml), '', "$name: the XML is as TC6 2.01 has it");
	my $taken = `$ladder import first.xml -o back.rung 2>&1`;
	is($?, 0, "$name: imported") or diag($taken), next;
	is(slurp('back.rung'), slurp($sample), "$name: it is the sample") if $single;
	system("$ladder export --as plcopen back.rung -o second.xml 2>trouble");
	ok(slurp('second.xml') eq $xml, "$name: the second XML is the first");

	# What is drawn, alone.
	spew('bare.xml', bare($xml));
	isnt(slurp('bare.xml'), $xml, "$name: there is a text beside the drawing");
	my $report = `$ladder import bare.xml -o bare.rung 2>&1`;
	spew('script', script(slurp('back.rung'), 42));
	my ($was, $is) = (traced($sample, '--changes'), traced('bare.rung', '--changes'));
	if ($differs{$name}) {
		like($said, qr/: (?:lost|changed): .*$differs{$name}/, "$name: the drawing says less, and the report says so");
		isnt($is, $was, "$name: which the sample needs");
		next;
	}
	ok($is eq $was && $was =~ /t=/, "$name: the drawing alone does the same") or diag(first_difference($was, $is) . "\n$said$report");
	system("$ladder export --as plcopen bare.rung -o bare2.xml 2>trouble && $ladder import bare2.xml -o bare3.rung >trouble 2>&1");
	is(slurp('bare3.rung'), slurp('bare.rung'), "$name: and stays the same from then on");
}

# Networks by their drawing alone: a call that waits for EN, what takes its ENO, pins that stay open, negated pins.
{
	my @network = ("Diff := SUB(EN := Ready, IN1 := Raw, IN2 := Tare, ENO => Sure)", "Tare := ADD(EN := R_EDGE(Go), IN1 := Tare, IN2 := 3)",
		"Sum := ADD(Raw, Tare)", "Wait(EN := NOT Go, IN := Ready, PT := T#30ms)\n  Late := Wait.Q", "Count(CU := Go, R := NOT Ready, PV := 4)\n  Full := Count.Q",
		"Kept S= Go AND NOT Late", "Kept R= Ready OR Full");
	spew('networks.rung', "RUNGBOARD 1\nVAR\n  Go AT %IX0.0 : BOOL;\n  Ready AT %IX0.1 : BOOL;\n  Raw AT %IW2 : INT;\n"
		. "  Tare : INT;\n  Diff : INT;\n  Sum : INT;\n  Sure : BOOL;\n  Late : BOOL;\n  Full : BOOL;\n  Kept : BOOL;\n  Wait : TON;\n  Count : CTU;\nEND_VAR\n"
		. "PROGRAM Main FBD\n" . join('', map { "NETWORK\n  $_\n" } @network) . "END_PROGRAM\n");
	my $said = `$ladder export --as plcopen networks.rung -o networks.xml 2>&1`;
	spew('bare.xml', bare(slurp('networks.xml')));
	my $report = `$ladder import bare.xml -o bare.rung 2>&1`;
	spew('script', script(slurp('networks.rung'), 7));
	my ($was, $is) = (traced('networks.rung', '--changes'), traced('bare.rung', '--changes'));
	ok($is eq $was && $was =~ /Diff=-?[1-9]/ && $was =~ /Tare=[1-9]/ && $was =~ /Late=1/, 'networks: the drawing alone does the same') or
		diag(first_difference($was, $is) . "\n$said$report");
}

# STOP is a box of that name, in a ladder and in a network; END of a program is a return.
for (["  | NO Go | COIL Lamp |\nRUNG\n  | NO Hot | NC Cold | STOP |\n", 'LD', 'RUNG'], ["  Lamp := Go\nNETWORK\n  STOP IF AND(Hot, NOT Cold)\n", 'FBD', 'NETWORK'],
	["  | NO Go | COIL Lamp |\nRUNG\n  | NO Hot | END |\nRUNG\n  | NC Cold | STOP |\n", 'LD', 'RUNG'], ["  Lamp := Go\nNETWORK\n  STOP\n", 'FBD', 'NETWORK']) {
	my ($body, $language, $word) = @$_;
	spew('stop.rung', "RUNGBOARD 1\n\nPROGRAM Main $language\nVAR\n" . join('', map { "  $_->[0] AT %$_->[1] : BOOL;\n" } ['Go', 'IX0.0'], ['Hot', 'IX0.1'], ['Cold', 'IX0.2'], ['Lamp', 'QX0.0']) .
		"END_VAR\n$word\n${body}END_PROGRAM\n");
	my $said = `$ladder export --as plcopen stop.rung -o stop.xml 2>&1`;
	unlike($said, qr/lost/, "$language: STOP and END are in the XML itself");
	is(PlcopenShape::wrong(slurp('stop.xml')), '', 'as TC6 2.01 has a box');
	spew('bare.xml', bare(slurp('stop.xml')));
	my $report = `$ladder import bare.xml -o bare.rung 2>&1`;
	my ($is) = slurp('bare.rung') =~ /^END_VAR\n$word\n(.*)END_PROGRAM/ms;
	is($is, $body =~ s/\bEND\b/RET/r, "$language: and come back from it") or diag($report);
}
# VAR_CONFIG is in the format itself.
{
	system("$ladder export --as plcopen '$tests/golden/config-located/main.rung' -o located.xml 2>trouble");
	is(PlcopenShape::wrong(slurp('located.xml')), '', 'VAR_CONFIG: the XML is as TC6 2.01 has it');
	spew('bare.xml', bare(slurp('located.xml')));
	system("$ladder import bare.xml -o bare.rung >trouble 2>&1");
	my ($was) = slurp("$tests/golden/config-located/main.rung") =~ /^\s*VAR_CONFIG\n(.*?)^\s*END_VAR/ms;
	my ($is) = slurp('bare.rung') =~ /^VAR_CONFIG\n(.*?)^END_VAR/ms;
	# Each comment in its own form.
	is($is =~ s/\s+/ /gr =~ s/\(\* (.*?) \*\)/\/\/ $1/gr, $was =~ s/\s+/ /gr, 'VAR_CONFIG comes back from the XML alone');
}

# Namespaces: names stand without them, but where a variable of the POU has the same name. Other tools get globals that
# a POU reads in its interface.
{
	my $spaces = "RUNGBOARD 1\n\nNAMESPACE Plant\n\nVAR_GLOBAL\n  Go AT %IX0.0 : BOOL;\n  n : INT := 3;\n  m : INT;\n  Lamp : BOOL;\nEND_VAR\n\nEND_NAMESPACE\n\n"
		. "PROGRAM Main ST\nVAR\n  x : INT;\nEND_VAR\n  IF Plant.Go THEN\n    Plant.n := Plant.n + 1; // Plant.n\n  END_IF;\n  x := n;\n  m := x;\nEND_PROGRAM\n\n"
		. "PROGRAM Rungs LD\nRUNG\n  | NO Plant.Go | [ Plant.n > 4 ] | COIL Plant.Lamp |\nEND_PROGRAM\n\n"
		. "PROGRAM Chart SFC\n  INITIAL_STEP A:\n    Add(N);\n  END_STEP\n\n  STEP B:\n  END_STEP\n\n  TRANSITION FROM A TO B := Plant.n > 6; END_TRANSITION\n"
		. "  TRANSITION FROM B TO A := Plant.n < 6; END_TRANSITION\n\n  ACTION Add:\n    Plant.m := Plant.m + 100;\n    More();\n  END_ACTION\nEND_PROGRAM\n\nACTION More:\n  Plant.m := Plant.m + 1000;\nEND_ACTION\n";
	spew('spaces.rung', $spaces);
	my $said = `$ladder export --as plcopen spaces.rung -o spaces.xml 2>&1`;
	is($?, 0, 'namespaces: exported') or diag($said);
	like($said, qr/^spaces\.rung: changed: the format has no namespaces: names stand without them$/m, 'which the report says');
	my $drawn = bare(slurp('spaces.xml'));
	is(PlcopenShape::wrong(slurp('spaces.xml')), '', 'the XML is as TC6 2.01 has it');
	is(join(' ', grep { !m{^Plant\.n$} } $drawn =~ /Plant\.\w+/g), '', 'no namespace is left') or diag($drawn);
	is(scalar(() = $drawn =~ m{<externalVars>}g), 3, 'each POU has what it reads of them in its interface');
	spew('bare.xml', $drawn);
	my $report = `$ladder import bare.xml -o bare.rung 2>&1`;
	is($?, 0, 'the drawing alone is imported') or diag($report);
	like(slurp('bare.rung'), qr/^ACTION More:\n  m := m \+ 1000;/m, 'an action behind a chart is there');
	spew('script', "\@print n m x Lamp\nGo=1\n. x8\nGo=0\n. x3\n");
	my ($was, $is) = map { traced($_, '') =~ s/ \w+\.x=/ x=/gr } 'spaces.rung', 'bare.rung';
	ok($is eq $was && $was =~ /Lamp=1/ && $was =~ /m=1\d{3}/, 'and does the same') or diag(first_difference($was, $is) . "\n$was$is");
	system("$ladder import spaces.xml -o back.rung >trouble 2>&1");
	like(slurp('back.rung'), qr/^NAMESPACE Plant\n.*Plant\.n := Plant\.n \+ 1;.*^END_PROGRAM\n\nACTION More:/ms, 'with the text beside it all of it comes back');

	# A variable of the POU hides the other one.
	spew('hidden.rung', $spaces =~ s/  x : INT;/  x : INT;\n  n : INT;/r);
	$said = `$ladder export --as plcopen hidden.rung -o hidden.xml 2>&1`;
	like($said, qr/^hidden\.rung:\d+: lost: (?:Main: )?the format has no namespaces: other tools do not find Plant\.n$/m, 'a name that means another variable without its namespace is told') or diag($said);
	like(slurp('hidden.xml'), qr/ {4}Plant\.n := Plant\.n \+ 1;/, 'and stays');
}

# What a function stores into a variable right behind it, with an order for both, comes back as one line.
{
	my $lines = "NETWORK\n  A := MOVE(EN := Go, IN := 5, ENO => MOVEENO_1)\n  B := MOVE(EN := MOVEENO_1, IN := 6)\n  Ok := MOVEENO_1\n";
	spew('stores.rung', "RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  A : INT;\n  B : INT;\n  Ok : BOOL;\nEND_VAR\n\nPROGRAM Main FBD\n${lines}END_PROGRAM\n");
	system("$ladder export --as plcopen stores.rung -o stores.xml 2>trouble");
	spew('bare.xml', bare(slurp('stores.xml')));
	system("$ladder import bare.xml -o bare.rung >trouble 2>&1");
	like(slurp('bare.rung'), qr/^\Q$lines\EEND_PROGRAM/m, 'a store right behind its function is one line again') or diag(slurp('bare.rung'));
}

# A comment stands above its network, also where the one before ends as near to it.
{
	my $lines = "NETWORK One\n  A := R_EDGE(Go)\n(* of the second *)\nNETWORK Two\n  B := F_EDGE(Go)\n";
	spew('titles.rung', "RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n  A : BOOL;\n  B : BOOL;\nEND_VAR\n\nPROGRAM Main FBD\n${lines}END_PROGRAM\n");
	system("$ladder export --as plcopen titles.rung -o titles.xml 2>trouble");
	spew('bare.xml', bare(slurp('titles.xml')));
	system("$ladder import bare.xml -o bare.rung >trouble 2>&1");
	like(slurp('bare.rung'), qr/^\Q$lines\EEND_PROGRAM/m, 'a comment between two networks is of the second one') or diag(slurp('bare.rung'));
}

# The look at the XML notices what is wrong: each of these changes of a good one.
my $good = slurp('first.xml');
for ([qr/ localId="\d+"/, ''], [qr/ (?:x|y)="\d+"\/>/, '/>'], [qr/<position [^>]*>/, ''], [qr/<connectionPointOut\/>/, '<connectionPointOut/><connectionPointOut/>'],
	[qr/<variable>/, '<expression>'], [qr/localId="3"/, 'localId="2"'], [qr/refLocalId="\d+"/, 'refLocalId="99999"'], [qr/<inOutVariables\/>/, ''],
	[qr/<types>/, '<kinds>'], [qr/ priority="\d+"/, ''], [qr/pouType="program"/, 'pouType="class"'], [qr/ handleUnknown="\w+"/, ''], [qr/formalParameter="Q"\/>/, 'formalParameter="QQ"/>'],
	[qr/<BOOL\/>/, '<BOOLEAN/>'], [qr/tc6_0201"/, 'tc6_0200"'], [qr/<documentation>/, '<documentation>words'], [qr/negated="true"/, 'negated="yes"'], [qr/<xhtml:p>/, '<xhtml:p><b/>']) {
	my ($was, $is) = @$_;
	my $bad = $good =~ s/$was/$is/r;
	isnt(PlcopenShape::wrong($bad), '', "not as TC6 has it: $is instead of $was") if $bad ne $good;
}

# Random ladders: two outputs may branch, boxes may lead on or to nothing, coils may be read again in their rung. Where
# the report says nothing, the drawing alone does the same.
my (@in, @bit, %instance) = map { "in$_" } 0 .. 5;
@bit = map { "b$_" } 0 .. 5;
sub one_of { return $_[rand @_] }
sub contact {
	my $n = int rand 14;
	return one_of('NO ', 'NC ') . one_of(@in, @bit) if $n < 9;
	return one_of('P ', 'N ') . one_of(@in) if $n < 10;
	return 'NOT' if $n < 11;
	return '[ n > ' . int(rand 6) . ' ]' if $n < 12;
	my $type = one_of(qw(TON TOF R_TRIG F_TRIG));
	my $name = lc($type) . keys %instance;
	$instance{$name} = $type;
	return "$type $name" . ($type =~ /^T/ ? ' PT:=T#' . int(10 + rand 50) . 'ms' : '');
}
sub output {
	my $n = int rand 12;
	return one_of('COIL ', 'COIL ', 'COILNOT ', 'S ', 'R ', 'COILP ') . one_of(@bit) if $n < 9;
	return '[ n := n + 1 ]' if $n < 11;
	return 'MOVE IN:=' . int(rand 5) . ' OUT=>n';
}
sub random_rung {
	my $width = 1 + int rand 4;
	my @row = ([(map { contact() } 1 .. $width), output()]);
	$row[0][-1] = '---' if rand() < 0.1 && $row[0][-2] =~ /^(?:TON|TOF)/;
	push @row, [(map { contact() } 1 .. $width - 1), contact() . ' ^'] if rand() < 0.5;
	if ($row[1] && $width > 1 && rand() < 0.5) { my $k = 1 + int rand($width - 1); $row[1] = [@{$row[1]}[0 .. $k - 1]]; $row[1][-1] =~ s/(?: \^)?$/ ^/ }
	if (@row == 1 && rand() < 0.4) {
		my $k = int rand $width;
		push @row, [(map { ' ' } 1 .. $k), ' ^', (map { contact() } 2 .. $width - $k), output()];
	}
	return "RUNG\n" . join '', map { '  | ' . join(' | ', @$_) . " |\n" } @row;
}
my (@unequal, $silent, $checked);
for my $seed ($ENV{SEED} // 1 .. $ENV{PROJECTS} // 150) {
	srand $seed;
	%instance = ();
	my $body = join '', map { random_rung() } 1 .. 3;
	$body =~ s/ \^ \|/ ^|/g;
	spew('random.rung', "RUNGBOARD 1\nVAR\n" . join('', map { "  $in[$_] AT %IX0.$_ : BOOL;\n" } 0 .. $#in) . join('', map { "  $_ : BOOL;\n" } @bit)
		. "  n : INT;\n" . join('', map { "  $_ : $instance{$_};\n" } sort keys %instance) . "END_VAR\nPROGRAM Main LD\n${body}END_PROGRAM\n");
	next if system("$ladder check random.rung >trouble 2>&1");
	$checked++;
	my $said = `$ladder export --as plcopen random.rung -o random.xml 2>&1` =~ s/^.*(?:warning|hint).*\n//gmr;
	spew('bare.xml', bare(slurp('random.xml')));
	push @unequal, "$seed: " . PlcopenShape::wrong(slurp('random.xml')) if PlcopenShape::wrong(slurp('random.xml'));
	$silent++ if $said eq '';
	next if $said ne '';
	spew('script', join '', '@print ', join(' ', @bit, 'n'), "\n", map { join(' ', map { "$_=" . int rand 2 } @in) . "\n" } 1 .. 30);
	my ($was, $is) = (traced('random.rung', ''), traced('bare.xml', ''));
	push @unequal, "$seed: " . first_difference($was, $is) . "\n" . slurp('random.rung') . `$ladder import bare.xml 2>&1` if $was ne $is || $was !~ /^1 t=/;
}
is(scalar @unequal, 0, "$silent of $checked random ladders do the same by their drawing") or diag(join "\n", @unequal[0 .. ($#unequal > 2 ? 2 : $#unequal)]);
cmp_ok($silent, '>', $checked / 2, 'the report is silent about most');
cmp_ok($silent, '<', $checked, 'and not about all');
done_testing;
