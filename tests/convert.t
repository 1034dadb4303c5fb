#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# convert.t - what `ladder export --as` st, fbd and il write does the same as the program that it comes
# from: all samples with their scenarios, all golden cases that have a trace, and random programs.
#
#   convert.t [--seed N [LANGUAGE]]   one random program; both texts and the first difference are printed
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Copy qw(copy);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $random = "$build/tests/bin/differential";
my $count = $ENV{CONVERT_COUNT} // 300;
my $dir = tempdir(CLEANUP => 1);

# A trace without the variables that conversion adds, and without places of the program's text.
sub plain {
	my ($trace) = @_;
	$trace =~ s/ Rung\d+(?:_\d+|_edge(?:_\d+)?\.(?:CLK|Q))?=\S+//g;
	$trace =~ s/ (?:\w+\.)?\w+_(?:rises|falls)(?:_\d+)?\.(?:CLK|Q|N\d+)=\d//g;
	$trace =~ s/ (?:[\w.\[\]]+\.)?(?:Rung\d|_[A-Z]\d|EDGE\d+\.E\d)\w*(?:\.N\d+)?=\S+//g;
	$trace =~ s/^# (STOP|FAULT)[^\n]*\n/# $1\n/mg;
	return $trace;
}

sub trace_of {
	my ($file, $stimulus) = @_;
	return plain(scalar `cd $dir && $ladder trace '$file' '$stimulus' 2>/dev/null`);
}

sub first_difference {
	my ($one, $two) = @_;
	my @a = split /\n/, $one;
	my @b = split /\n/, $two;
	for my $i (0 .. ($#a > $#b ? $#a : $#b)) {
		return "was: " . ($a[$i] // '-') . "\nis:  " . ($b[$i] // '-') if ($a[$i] // '') ne ($b[$i] // '');
	}
	return '';
}

# Is a file of this kind converted? Then its text is in the second file.
sub converts {
	my ($from, $as, $to) = @_;
	my $said = `cd $dir && $ladder export --as $as '$from' -o '$to' 2>&1`;
	return ($? == 0, $said);
}

# Samples. Ladders of samples can all be converted.
sub sample {
	my ($sample, $as) = @_;
	my $name = basename($sample);
	copy($sample, "$dir/$name");
	my ($good, $said) = converts($name, $as, "$as-$name");
	ok($good, "$name: its ladders become $as") or diag($said), return;
	unlike(slurp("$dir/$as-$name"), qr/^PROGRAM \w+ LD/m, "$name: no ladder is left");
	(my $scenario = $sample) =~ s/rung$/scn/;
	# Steps of a chart have no names in Structured Text.
	return if !-e $scenario || ($as eq 'st' && slurp($sample) =~ /^PROGRAM \w+ SFC/m);
	copy($scenario, "$dir/$as-" . basename($scenario));
	(my $plant = $sample) =~ s/rung$/plant.rung/;
	copy($plant, "$dir/$_" . basename($plant)) for -e $plant ? ('', "$as-") : ();
	my $tap = `cd $dir && $ladder test '$as-$name' 2>&1`;
	ok($? == 0 && $tap =~ /^ok/m, "$name: its scenarios hold as $as") or diag($tap);
}

for my $sample (sort(glob("$tests/../ladders/*.rung"), glob("$tests/../ladders/*/*.rung"))) {
	next unless slurp($sample) =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK)\b.* LD$/m && $sample !~ /plant\.rung$/;
	next if slurp($sample) =~ /^(?:INCLUDE|USES)/m;
	sample($sample, $_) for 'st', 'fbd';
}

# Golden cases with a trace.
my %done = (st => 0, fbd => 0, il => 0);
for my $case (sort glob "$tests/golden/*") {
	next unless -e "$case/main.rung" && -e "$case/expected.trace";
	my $name = basename($case);
	next if -e "$case/stimulus" && slurp("$case/stimulus") =~ /\.N\d/; # a wire has another name in a list
	system "cp $case/* $dir/";
	for my $as ('st', 'fbd', 'il') {
		next if $as eq 'st' && slurp("$case/main.rung") =~ /^PROGRAM \w+ SFC/m; # its steps lose their names
		next if $as eq 'st' && slurp("$case/main.rung") !~ /^\w+ .* ?(?:LD|FBD)$/m;
		next if $as eq 'fbd' && slurp("$case/main.rung") !~ /^\w+ .* ?LD$/m;
		my ($good, $said) = converts('main.rung', $as, "$as.rung");
		if (!$good) {
			ok($said =~ m{error LD78}, "$name: a reason why it does not become $as") or diag(join "\n", grep { !m{warning} } split m{\n}, $said);
			next;
		}
		my ($was, $is) = (trace_of('main.rung', 'stimulus'), trace_of("$as.rung", 'stimulus'));
		$done{$as}++;
		ok($is eq $was && $was ne q(), "$name as $as") or diag(first_difference($was, $is));
	}
	unlink glob "$dir/*.rung";
}
ok($done{st} > 100 && $done{fbd} > 100 && $done{il} > 150,
   'most golden cases are converted: ' . join ', ', map { "$done{$_} $_" } sort keys %done);

# Charts become ladders, and these Structured Text: both texts do the same.
for my $sample (qw(sequence-s0-s8 press-two-hand traffic-crossing)) {
	copy("$tests/../ladders/$sample.rung", "$dir/chart.rung");
	converts('chart.rung', 'ld', 'chart-ld.rung');
	my ($good, $said) = converts('chart.rung', 'st', 'chart-st.rung');
	ok($good, "$sample: its charts become Structured Text") or diag($said), next;
	srand 7;
	spew("$dir/s", '@print %QB0 %QB1' . "\n" . join '', map { sprintf "%%IX0.%d=%d\n", rand 8, rand 2 } 1 .. 200);
	my $was = trace_of('chart-ld.rung', 's');
	ok($was =~ /^200 t=/m && $was eq trace_of('chart-st.rung', 's'), "$sample: both do the same");
}

# Networks: their wires have other names, so only the variables of both are compared.
sub network {
	my ($number) = @_;
	my (@bit, @int);
	my $bit = sub { ('%IX0.' . int rand 8, map({ "b$_" } 0 .. 3), @bit, @bit)[rand 12 + 2 * @bit] // 'c1' };
	my $int = sub { ('n' . int rand 3, @int, int rand 9)[rand 2 + @int] };
	my $text = 'NETWORK ' . (rand() < 0.1 ? 'OFF ' : '') . "L$number\n";
	for my $line (1 .. 2 + rand 6) {
		my $wire = "w$line" . '_' x ($number % 3);
		my $kind = int rand 10;
		my ($p, $q, $m, $n) = ($bit->(), $bit->(), $int->(), $int->());
		if ($kind == 0) { $text .= "  $wire := $p AND NOT $q\n"; push @bit, $wire }
		elsif ($kind == 1) { $text .= "  $wire := ADD($m, n1)\n"; push @int, $wire }
		elsif ($kind == 2) { $text .= "  b" . int(rand 4) . ' ' . (rand() < 0.5 ? 'S' : 'R') . "= $p XOR $q\n" }
		elsif ($kind == 3) { $text .= "  $wire := " . (rand() < 0.5 ? 'R' : 'F') . "_EDGE($p OR $q)\n"; push @bit, $wire }
		elsif ($kind == 4) { $text .= "  $wire := ADD(PREVIOUS($wire), SEL($p, n0, $m))\n"; push @int, $wire }
		elsif ($kind == 5) { $text .= "  $wire := SUB(EN := $p, IN1 := n2, IN2 := $n, ENO => e$wire)\n"; push @int, $wire; push @bit, "e$wire" }
		elsif ($kind == 6) { $text .= "  n" . int(rand 3) . " := MUL($m, n0) / $n\n" }
		elsif ($kind == 7) { $text .= "  t" . int(rand 2) . "(IN := $p, PT := T#20ms)\n  b" . int(rand 4) . " := t0.Q AND $q\n" }
		elsif ($kind == 8) { $text .= "  b" . int(rand 4) . " := n0 > $m OR R_EDGE($q)\n" }
		else { $text .= rand() < 0.7 ? '  JMP L' . ($number + 1) . " IF $p\n" : "  RETURN IF $p AND $q AND c1\n" }
	}
	return $text;
}

my ($networks, $unequal) = (0, '');
for my $seed (1 .. ($ENV{CONVERT_COUNT} // 200)) {
	srand $seed;
	my $body = join '', map { network($_) } 1 .. 5;
	spew("$dir/n.rung", "RUNGBOARD 1\n\nVAR\n" . join('', map { "  b$_ : BOOL;\n" } 0 .. 3) .
	     join('', map { "  n$_ : INT := $_;\n" } 0 .. 2) . "  t0 : TON;\n  t1 : TON;\n  c1 : BOOL := TRUE;\nEND_VAR\n\n" .
	     "PROGRAM Main FBD\n${body}NETWORK L6\n  c1 := NOT %IX0.0\nEND_PROGRAM\n");
	next if system("cd $dir && $ladder check n.rung >/dev/null 2>&1");
	my ($good, $said) = converts('n.rung', 'st', 'm.rung');
	spew("$dir/s", '@print ' . join(' ', map({ "b$_" } 0 .. 3), 'n0 n1 n2 t0.ET t1.Q c1 SYS_ERRORS') . "\n" .
	     join '', map { sprintf "%%IX0.%d=%d %%IX0.%d=%d\n", rand 8, rand 2, rand 8, rand 2 } 1 .. 20);
	my ($was, $is) = (trace_of('n.rung', 's'), $good ? trace_of('m.rung', 's') : $said);
	$networks++;
	$unequal .= "seed $seed: " . first_difference($was, $is) . "\n" if $was ne $is || $was !~ /^20 t=/m;
}
is($unequal, '', "$networks random programs of networks and their Structured Text do the same");
ok($networks > ($ENV{CONVERT_COUNT} // 200) / 4, 'many random networks are good');

# Random programs.
sub names_of {
	my ($text) = @_;
	my %seen;
	my @block = $text =~ /^VAR\n(.*?)^END_VAR/msg;
	$seen{$1} = 1 while ($block[0] // '') =~ /^\s*(\w+)[^:\n]*:\s*(?:BOOL|S?INT|DINT|U(?:S|D)?INT|BYTE|D?WORD|TIME|REAL);/mg;
	return sort keys %seen;
}

sub stimulus {
	my ($seed, @names) = @_;
	my $text = '@print ' . join(' ', @names, '%QB0', '%QB1', '%MB0', '%MB1', 'SYS_ERRORS') . "\n";
	srand $seed;
	for (1 .. 12) {
		$text .= join ' ', map { sprintf '%%IX%d.%d=%d', rand 8, rand 8, rand 2 } 1 .. 4;
		$text .= "\n";
	}
	return $text;
}

my (%same, %refused, @bad, %why);
my $only = @ARGV > 1 && $ARGV[0] eq '--seed' ? $ARGV[1] : 0;
my @as = $ARGV[2] // ('st', 'fbd');
for my $seed ($only ? $only : 1 .. $count) {
	my $program = `$random --seed $seed --text`;
	spew("$dir/a.rung", $program);
	next if system("cd $dir && $ladder check a.rung >/dev/null 2>&1");
	spew("$dir/s", stimulus($seed, names_of($program)));
	my $was = trace_of('a.rung', 's');
	for my $as (@as) {
		my ($good, $said) = converts('a.rung', $as, 'b.rung');
		if (!$good) {
			$refused{$as}++;
			$said =~ /error (LD\d+)/;
			$why{$1 // $said}++;
			push @bad, "seed $seed: $as: $said" if ($1 // '') !~ /^LD78/;
			next;
		}
		my $is = trace_of('b.rung', 's');
		$same{$as} += $was eq $is && $was =~ /^1 t=/;
		push @bad, "seed $seed: $as: " . first_difference($was, $is) if $was ne $is;
		print $program, slurp("$dir/b.rung"), first_difference($was, $is), "\n" if $only;
	}
}
is(@bad, 0, 'random programs do the same: ' . join ', ', map { "$same{$_} as $_, " . ($refused{$_} // 0) . ' refused' } sort keys %same)
	or diag(join "\n", @bad[0 .. ($#bad < 9 ? $#bad : 9)]);
diag(join ', ', map { "$_: $why{$_}" } sort keys %why) if $ENV{CONVERT_SAY};
for my $as (@as) {
	ok($only || $same{$as} * 2 > $count, "most random programs can be converted to $as");
}
done_testing();
