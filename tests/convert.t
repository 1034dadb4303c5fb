#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# convert.t - what `ladder export --as st` and `--as il` write does the same as the program that it comes
# from: all samples with their scenarios, all golden cases that have a trace, and random programs.
#
#   convert.t [--seed N]   one random program; both texts and the first difference are printed
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
	$trace =~ s/ (?:\w+\.)?\w+_(?:rises|falls)(?:_\d+)?\.(?:CLK|Q)=\d//g;
	$trace =~ s/ (?:[\w.\[\]]+\.)?(?:Rung\d|_[A-Z]\d)\w*=\S+//g;
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
for my $sample (sort glob "$tests/../ladders/*.rung") {
	my $name = basename($sample);
	copy($sample, "$dir/$name");
	next unless slurp($sample) =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK)\b.* LD$/m;
	my ($good, $said) = converts($name, 'st', "st-$name");
	ok($good, "$name: its ladders become Structured Text") or diag($said), next;
	unlike(slurp("$dir/st-$name"), qr/^PROGRAM \w+ LD/m, "$name: no ladder is left");
	(my $scenario = $sample) =~ s/rung$/scn/;
	next unless -e $scenario;
	copy($scenario, "$dir/st-" . basename($scenario));
	(my $plant = $sample) =~ s/rung$/plant.rung/;
	copy($plant, "$dir/st-" . basename($plant)) if -e $plant;
	my $tap = `cd $dir && $ladder test 'st-$name' 2>&1`;
	ok($? == 0 && $tap =~ /^ok/m, "$name: its scenarios hold") or diag($tap);
}

# Golden cases with a trace.
my %done = (st => 0, il => 0);
for my $case (sort glob "$tests/golden/*") {
	next unless -e "$case/main.rung" && -e "$case/expected.trace";
	my $name = basename($case);
	next if -e "$case/stimulus" && slurp("$case/stimulus") =~ /\.N\d/; # a wire has another name in a list
	system "cp $case/* $dir/";
	for my $as ('st', 'il') {
		next if $as eq 'st' && slurp("$case/main.rung") !~ /^\w+ .* ?LD$/m;
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
ok($done{st} > 100 && $done{il} > 150, "most golden cases are converted: $done{st} st, $done{il} il");

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

my ($same, $refused) = (0, 0);
my (@bad, %why);
my $only = @ARGV == 2 && $ARGV[0] eq '--seed' ? $ARGV[1] : 0;
for my $seed ($only ? $only : 1 .. $count) {
	my $program = `$random --seed $seed --text`;
	spew("$dir/a.rung", $program);
	next if system("cd $dir && $ladder check a.rung >/dev/null 2>&1");
	my ($good, $said) = converts('a.rung', 'st', 'b.rung');
	if (!$good) {
		$refused++;
		$said =~ /error (LD\d+)/;
		$why{$1 // $said}++;
		push @bad, "seed $seed: $said" if ($1 // '') !~ /^LD78/;
		next;
	}
	spew("$dir/s", stimulus($seed, names_of($program)));
	my ($was, $is) = (trace_of('a.rung', 's'), trace_of('b.rung', 's'));
	$same += $was eq $is && $was =~ /^1 t=/;
	push @bad, "seed $seed: " . first_difference($was, $is) if $was ne $is;
	print $program, slurp("$dir/b.rung"), first_difference($was, $is), "\n" if $only;
}
is(@bad, 0, "$same random programs do the same, $refused are refused") or diag(join "\n", @bad[0 .. ($#bad < 9 ? $#bad : 9)]);
diag(join ', ', map { "$_: $why{$_}" } sort keys %why) if $ENV{CONVERT_SAY};
ok($only || $same * 2 > $count, 'most random programs can be converted');
done_testing();
