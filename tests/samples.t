#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# samples.t - every program in ladders/ has no error, is canonical and passes its scenarios. The
# scenarios must notice nearly every contact that is inverted or bridged, in a chart every
# changed condition and every line, priority, supervision and control that is left out, and in
# Structured Text nearly every turned condition, changed operator and statement that is left
# out. Samples are found by their names.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $top = abs_path(dirname(__FILE__) . '/..');
my $build = abs_path($ENV{BUILD} // "$top/build");
my $ladder = $ENV{LADDER} ? abs_path($ENV{LADDER}) : "$build/ladder";
my $folder = tempdir(CLEANUP => 1);
my $noticed_least = 0.9; # interlocks that are made twice cannot be noticed
my $missed_most = 0.1;   # of the changed statements of a sample
# Lines of a chart that are made twice, so that leaving out one is not noticed: how many,
# and in which sample.
my %twice = ('sequence-s0-s8' => 2); # S6 and S7 both reset Q0.5, as in the published chart

# Of these only each so manieth change is tried; EVERY=1 tries all.
my %every = ('cement-plant' => 30);

# An instruction with N added or removed.
sub broken_line {
	my ($i, @lines) = @_;
	my $was = $lines[$i];

	$lines[$i] =~ s/^(\s+)(LD|AND|OR|JMPC|RETC|CALC)(N?)(?= |$)/$1 . $2 . ($3 ? '' : 'N')/e
		or return;
	return { line => $i + 1, row => $was, kind => 'list', text => join("\n", @lines) };
}

# The alternatives of a line of a chart; empty: without it.
sub broken_chart_line {
	my ($line) = @_;

	if (my ($before, $is) = $line =~ /^(\s+TRANSITION .* := )(.+)(?=; END_TRANSITION$)/) {
		my @else = $is eq 'TRUE' ? ('FALSE') : ("NOT ($is)", 'TRUE');
		my @all = map { "$before$_; END_TRANSITION" } @else;
		push @all, $line =~ s/\(PRIORITY := \d+\) //r;
		return grep { $_ ne $line } @all;
	}
	return ($line =~ s/\(PRIORITY := \d+\) //r) if $line =~ /^\s+TRANSITION .*\(PRIORITY/;
	return ('') if $line =~ /^\s+\w+\([A-Z].*\);$/ && $line !~ /^\s+CONTROL\(/;
	if (my ($word, $of) = $line =~ /^(\s+(?:CONTROL\(|SET |RESET ))(.+?)(?=\)?;$)/) {
		my @of = split /, /, $of;
		my $end = $word =~ /\($/ ? ');' : ';';
		return ('') if @of == 1;
		return map { my $not = $_; $word . join(', ', @of[grep { $_ != $not } 0 .. $#of]) . $end } 0 .. $#of;
	}
	return map { $line =~ s/\Q$_\E//r } $line =~ /(M(?:IN|AX) := [^,]+, )/g if $line =~ /\bSTEP \w+ \(/;
	return;
}

# The chart, changed once in each way.
sub broken_chart {
	my (@lines) = @_;
	my (@all, $in);

	for my $i (0 .. $#lines) {
		$in = 1 if $lines[$i] =~ /^PROGRAM \w+ SFC/;
		$in = 0 if $lines[$i] =~ /^END_PROGRAM/;
		next if !$in;
		for my $with (broken_chart_line($lines[$i])) {
			my @copy = @lines;
			$copy[$i] = $with;
			push @all, { line => $i + 1, row => "$lines[$i] -> $with", kind => 'chart',
				     text => join("\n", @copy) };
		}
	}
	return @all;
}

# The alternatives of a line of Structured Text; empty: without it.
sub broken_statement {
	my ($line) = @_;
	my @all;

	my $code = $line =~ s/ *\(\*.*?\*\) *$| *\/\/.*//r;
	if (my ($before, $is, $after) = $code =~ /^(\s*(?:IF|ELSIF|WHILE|UNTIL) )(.+?)((?: THEN| DO|;)?)$/) {
		push @all, map { "$before$_$after" } "NOT ($is)", 'TRUE', 'FALSE';
	} elsif ($code =~ /^\s+[\w.,\[\]]+(?: :=.*|\(.*\));$/ || $code =~ /^\s+(?:EXIT|CONTINUE|RETURN);$/) {
		push @all, '';
	}
	my %other = (AND => 'OR', OR => 'AND', AND_THEN => 'OR', '+' => '-', '-' => '+', '*' => '+', '/' => '*',
		     '>' => '<=', '<' => '>=', '>=' => '<', '<=' => '>', '=' => '<>', '<>' => '=');
	while ($code =~ / \K(?:AND|OR|AND_THEN|[-+*\/]|[<>]=?|=|<>)(?= )/g) {
		my $with = $other{$&};
		push @all, substr($code, 0, $-[0]) . $with . substr($code, $+[0]);
	}
	push @all, $code =~ s/\bTRUE\b/FALSE/r if $code =~ /:= TRUE\b/;
	push @all, $code =~ s/\bFALSE\b/TRUE/r if $code =~ /:= FALSE\b/;
	return @all;
}

# The bodies in Structured Text, changed once in each way.
sub broken_statements {
	my ($plain, @lines) = @_;
	my (@all, $st, $in, $comment);

	for my $i (0 .. $#lines) {
		$st = 1 if $lines[$i] =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK) .* ST$/ || $plain;
		$in = $st if $lines[$i] =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK) /;
		$in = $st = 0 if $lines[$i] =~ /^END_(?:PROGRAM|FUNCTION)/;
		$in = 0 if $lines[$i] =~ /^VAR/;
		if ($lines[$i] =~ /^END_VAR/) {
			$in = $st;
			next;
		}
		$comment = 1 if $lines[$i] =~ /^\s*\(\*/;
		for my $with ($in && !$comment ? broken_statement($lines[$i]) : ()) {
			my @copy = @lines;
			$copy[$i] = $with;
			push @all, { line => $i + 1, row => "$lines[$i] -> $with", kind => 'st', text => join("\n", @copy) };
		}
		$comment = 0 if $lines[$i] =~ /\*\)/;
	}
	return @all;
}

# The program with each contact changed once in each way.
sub broken {
	my ($text, $file) = @_;
	my @lines = split /\n/, $text, -1;
	my %turned = (NO => 'NC', NC => 'NO');
	my @all = (broken_chart(@lines), broken_statements(scalar($file =~ /\.st$/), @lines));
	for my $i (0 .. $#lines) {
		push @all, broken_line($i, @lines);
		next if $lines[$i] !~ /^\s*\|/;
		while ($lines[$i] =~ /\| \K(NO|NC) [\w.%]+/g) {
			my ($word, $at, $end) = ($1, $-[0], $+[0]);
			for my $with ($turned{$word}
				      . substr($lines[$i], $at + 2, $end - $at - 2),
				      '---') {
				my @copy = @lines;
				substr($copy[$i], $at, $end - $at) = $with;
				push @all, { line => $i + 1, row => $copy[$i], kind => 'contact',
					     text => join("\n", @copy) };
			}
		}
	}
	return @all;
}

my ($made, $noticed) = (0, 0);
# A sample is a rung file, a folder with one of its name, or a folder of plain IEC text. Names
# as arguments: only these.
my @rungs = (glob("$top/ladders/*.rung"), map { glob("$_/" . basename($_) . '*.rung') } glob("$top/ladders/*"));
my @plants = grep { /\.plant\.rung$/ } @rungs;
my %only = map { $_ => 1 } @ARGV;
my @programs = grep { !/\.plant\.rung$/ } @rungs, map { dirname($_) } glob("$top/ladders/*/main.st");
@programs = grep { $only{basename($_, '.rung')} } @programs if %only;
for my $program (@programs) {
	my $name = basename($program, '.rung');
	my $scenarios = -d $program ? "$program.scn" : $program =~ s/\.rung$/.scn/r;
	my $place = substr dirname($program), length "$top/ladders"; # empty: no folder of its own
	my @files = -d $program ? glob("$program/*") : $place ? grep { !/\.plant\.rung$/ } glob(dirname($program) . '/*.rung') : ($program);
	my ($status, $text) = answer('.', $ladder, 'check', $program);

	ok($status == 0 && $text !~ /warning|error/, "$name: good, no warning")
		or diag($text);
	($status, $text) = answer('.', $ladder, 'fmt', '--check', $place ? @files : $program);
	is($status, 0, "$name: canonical") or diag($text);
	# The welcome page shows its first sentence.
	my ($head) = -d $program ? "$program/main.st" : $program;
	like("\n" . slurp($head) =~ s/(?:^|\n)\(\*.*//sr, qr/^[^;]*$/, "$name: a comment says what it is, before any declaration");
	($status, $text) = answer('.', $ladder, 'test', $scenarios);
	is($status, 0, "$name: does what its scenarios say") or diag($text);
	my $count = () = $text =~ /^ok /mg;
	cmp_ok($count, '>=', 3, "$name: has scenarios");

	my $plant = $program =~ s/\.rung$/.plant.rung/r;
	mkdir "$folder$place" if $place;
	spew("$folder$place/$name.plant.rung", slurp($plant)) if $plant ne $program && -e $plant;
	spew("$folder$place/$name.scn", slurp($scenarios));
	if (-d $program) {
		mkdir "$folder/$name" or die "$folder/$name: $!";
	}
	if (-d $program || $place) {
		spew("$folder/$name/" . basename($_), slurp($_)) for @files;
	}
	my (%missed, %of);
	my $every = $ENV{EVERY} // $every{$name} // 1;
	my $nth = 0;
	for my $file (@files) {
		my $copy = "$folder/" . substr $file, length "$top/ladders/";
		for my $broken (broken(slurp($file), $file)) {
			next if $nth++ % $every;
			spew($copy, $broken->{text});
			($status, $text) = answer('.', $ladder, 'test', '--fail-fast', "$folder$place/$name.scn");
			next if $text =~ /^not ok 1 - .*: its program is good$/m; # it is not a program any more
			$of{$broken->{kind}}++;
			push @{ $missed{$broken->{kind}} }, "$broken->{line}: $broken->{row}" if !$status;
		}
		spew($copy, slurp($file));
	}
	my @missed = map { @$_ } values %missed;
	is(scalar @{ $missed{chart} // [] }, $twice{$name} // 0, "$name: its scenarios notice every change of the chart")
		or diag(join "\n", @{ $missed{chart} }) if $of{chart};
	cmp_ok(scalar @{ $missed{st} // [] }, '<=', $of{st} * $missed_most, "$name: its scenarios notice changed statements")
		or diag(join "\n", @{ $missed{st} }) if $of{st};
	note("$name: of $of{st} changed statements not noticed:\n", join "\n", @{ $missed{st} // [] }) if $of{st};
	my $of = 0;
	$of += $_ for values %of;
	$made += $of;
	$noticed += $of - @missed;
	cmp_ok(@missed, '<', $of / 2, "$name: its scenarios notice broken contacts")
		or diag(join "\n", @missed);
}
if (%only) {
	done_testing();
	exit;
}
for my $plant (@plants) {
	my $name = basename($plant, '.rung');
	my ($status, $text) = answer('.', $ladder, 'check', $plant);

	ok($status == 0 && $text !~ /warning|error/, "$name: good, no warning")
		or diag($text);
	($status, $text) = answer('.', $ladder, 'fmt', '--check', $plant);
	is($status, 0, "$name: canonical") or diag($text);
	my $scenarios = $plant =~ s/\.plant\.rung$/.scn/r;
	like(slurp($scenarios), qr/^\s*plant "\Q$name.rung\E"/m, "$name: a scenario is beside it");

	# A plant that does not move is noticed.
	my $other = basename($scenarios, '.scn');
	my $still = slurp($plant) =~ s/^RUNG\b/RUNG OFF/mgr;
	$still =~ s/^(PROGRAM \w+ ST\n(?:VAR\n.*?^END_VAR\n)*)/$1  RETURN;\n/msg;
	my $place = substr dirname($plant), length "$top/ladders";
	mkdir "$folder$place";
	spew("$folder$place/" . basename($_), slurp($_))
		for $place ? glob(dirname($plant) . '/*.rung') : "$top/ladders/$other.rung", $scenarios;
	spew("$folder$place/$name.rung", $still);
	($status, $text) = answer('.', $ladder, 'test', "$folder$place/$other.scn");
	isnt($status, 0, "$name: it matters what it does");
	unlike($text, qr/ error LD\d/, "$name: and it is not the file") or diag($text);
}
cmp_ok(@plants, '>=', 3, 'samples with a plant');
cmp_ok(@programs, '>=', 33, 'the samples were found');
cmp_ok($noticed, '>=', $noticed_least * $made,
       "broken contacts are noticed: $noticed of $made");
done_testing();
