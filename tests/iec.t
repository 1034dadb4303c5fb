#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# iec.t - runs the cases of tests/iec/cases.txt with the public commands: a generated
# program and `ladder trace`.
#
# Each case is a box, and a program has many cases. A refused program is tried again case by
# case, so that an unknown word fails alone. Numbers are compared as text, because 64 bits
# do not fit into a double.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = $ENV{BUILD} // "$tests/../build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
my $at_once = 100;

# Types of arguments that differ from the type of the case.
my %own = (SEL => { 0 => 'BOOL' }, MUX => { 0 => 'INT' },
	map { $_ => { 1 => 'INT' } } qw(SHL SHR ROL ROR));

# Standard output of a command, and both streams if it fails.
sub run {
	my (@command) = @_;
	my $pid = open my $from, '-|';
	die "fork: $!" if !defined $pid;
	if (!$pid) {
		open STDERR, '>', "$folder/errors" or die;
		exec @command or die "$command[0]: $!";
	}
	local $/;
	my $text = <$from> // '';
	close $from;
	return ($text, '') if $? == 0;
	open my $errors, '<', "$folder/errors" or die;
	return (undef, $text . (<$errors> // ''));
}

my %words = map { $_->{word} => $_ } grep { $_->{pins} }
	@{ decode_json((run($ladder, 'words', '--json'))[0]) };

sub read_cases {
	my (@cases, $case);
	my $source = '';
	open my $in, '<', "$tests/iec/cases.txt" or die "cases.txt: $!";
	while (my $line = <$in>) {
		chomp $line;
		if ($line =~ /^# ?(.*)/) {
			$source = $1;
		} elsif ($line =~ /^fn (\S+) (\S+) (\S+) (\S+): (.+) = (\S+)(?: \+- (\S+))?$/) {
			push @cases, { id => $1, word => $2, from => $3, to => $4,
				args => [split ' ', $5], result => $6, tol => $7,
				source => $source };
		} elsif ($line =~ /^fb (\S+) (\S+)(?: PT=(\d+))?$/) {
			push @cases, { id => $1, word => $2, pt => $3, steps => [],
				source => $source };
		} elsif ($line =~ /^  at (\d+): (.*?) ?=> ?(.*)$/) {
			my ($at, $in_pins, $out_pins) = ($1, $2, $3);
			push @{$cases[-1]{steps}}, { at => $at,
				in => { map { split /=/ } split ' ', $in_pins },
				out => { map { split /=/ } split ' ', $out_pins } };
		} elsif ($line ne '') {
			die "cases.txt:$.: $line\n";
		}
	}
	return @cases;
}

# ---- functions ----

sub pin_name {
	my ($word, $index) = @_;
	my $row = $words{$word} or return $index ? undef : 'IN';
	my @pins = @{$row->{pins}};
	return $pins[$index]{pin} if $index < @pins;
	my ($head, $number) = $pins[-1]{pin} =~ /^(\D+)(\d+)$/ or return 'NONE';
	return $head . ($number + $index - $#pins);
}

# A number in the notation of its type.
sub literal {
	my ($type, $text) = @_;
	return $text ? 'TRUE' : 'FALSE' if $type eq 'BOOL';
	return uc $text if $type !~ /REAL/ || $text =~ /\./;
	$text =~ s/e/.0E/i or $text .= '.0';
	return uc $text;
}

sub function_program {
	my (@cases) = @_;
	my $vars = '';
	my $rungs = '';
	for my $case (@cases) {
		my $box = $case->{word};
		for my $i (0 .. $#{$case->{args}}) {
			my $type = $own{$case->{word}}{$i} // $case->{from};
			$vars .= sprintf "  %s_%d : %s := %s;\n", $case->{name}, $i,
				$type, literal($type, $case->{args}[$i]);
		}
		$box .= join '', map { sprintf ' %s:=%s_%d', pin_name($case->{word}, $_) // 'NONE',
			$case->{name}, $_ } 0 .. $#{$case->{args}};
		$vars .= "  $case->{name} : $case->{to};\n";
		$rungs .= "RUNG\n  | $box OUT=>$case->{name} |\n";
	}
	return "RUNGBOARD 1\n\nVAR\n$vars" . "END_VAR\n\nPROGRAM Main LD\n$rungs" .
		"END_PROGRAM\n";
}

# The results of some cases by name; undef and the reason if there are none.
sub trace_functions {
	my (@cases) = @_;
	spew("$folder/main.rung", function_program(@cases));
	spew("$folder/script", '@print ' . join(' ', map { $_->{name} } @cases) . "\n.\n");
	my ($text, $errors) = run($ladder, 'trace', "$folder/main.rung", "$folder/script");
	return (undef, $errors) if !defined $text;
	return ({ $text =~ /(\w+)=(\S+)/g }, '');
}

sub same {
	my ($case, $got) = @_;
	return 0 if !defined $got;
	return $got eq $case->{result} if $case->{to} !~ /REAL/;
	return abs($got - $case->{result}) <= $case->{tol} if defined $case->{tol};
	my $form = $case->{to} eq 'REAL' ? 'f' : 'd';
	return pack($form, $got) eq pack($form, $case->{result});
}

sub judge_function {
	my ($case, $results, $errors) = @_;
	my $got = $results ? $results->{$case->{name}} : undef;
	my $call = "$case->{word}(" . join(', ', @{$case->{args}}) . ')';
	ok(same($case, $got), "$case->{id} $call = $case->{result}") or
		diag($case->{source}, "\n", defined $got ? "got $got" : $errors);
}

sub judge_functions {
	my (@cases) = @_;
	my ($results, $errors) = trace_functions(@cases);
	for my $case (@cases) {
		my ($own_results, $own_errors) = $results ? ($results, '') :
			trace_functions($case);
		judge_function($case, $own_results, $own_errors);
	}
}

# ---- function blocks ----

# Its pins are listed under its short name.
sub row_of {
	my ($word) = @_;
	my ($short) = $word =~ /^(\w+?)_(?:LTIME|INT)$/;
	return $words{$word} // $words{$short // ''};
}

sub pin_type {
	my ($row, $pin) = @_;
	my ($found) = grep { $_->{pin} eq $pin } @{$row->{pins}};
	return $found ? $found->{type} : 'BOOL';
}

sub block_program {
	my ($case, $word) = @_;
	my %in = map { %{$_->{in}} } @{$case->{steps}};
	$in{PT} = 1 if defined $case->{pt};
	my @pins = sort keys %in;
	my $vars = join '', map { sprintf "  v%s : %s;\n", $_,
		pin_type(row_of($word), $_) } @pins;
	my $call = join ', ', map { "$_ := v$_" } @pins;
	return "RUNGBOARD 1\n\nVAR\n  Block : $word;\n${vars}END_VAR\n\n" .
		"PROGRAM Main IL\n  CAL Block($call)\nEND_PROGRAM\n";
}

# Nanoseconds as a TIME in a trace: milliseconds.
sub milliseconds {
	my ($ns) = @_;
	my $text = sprintf '%07d', $ns;
	$text =~ s/(\d{6})$/.$1/;
	$text =~ s/\.?0+$// if $text =~ /\./;
	return $text eq '' ? '0' : $text;
}

sub block_script {
	my ($case) = @_;
	my %out = map { %{$_->{out}} } @{$case->{steps}};
	my $text = '@print ' . join(' ', map { "Block.$_" } sort keys %out) . "\n";
	my $now = -1000000;
	for my $step (@{$case->{steps}}) {
		my %in = (%{$step->{in}});
		$in{PT} //= $case->{pt} if defined $case->{pt};
		$in{PT} = "T#$in{PT}ns" if defined $in{PT};
		$text .= join(' ', '+' . ($step->{at} - $now) . 'ns',
			map { "v$_=$in{$_}" } sort keys %in) . "\n";
		$now = $step->{at};
	}
	return $text;
}

sub judge_block {
	my ($case) = @_;
	my $word = $case->{word};
	my $name = "$case->{id} $case->{word}";
	if (!row_of($word)) {
		fail($name);
		diag("no function block $word");
		return;
	}
	spew("$folder/main.rung", block_program($case, $word));
	spew("$folder/script", block_script($case));
	my ($text, $errors) = run($ladder, 'trace', "$folder/main.rung", "$folder/script");
	my @lines = split /\n/, $text // '';
	my $wrong = $errors;
	for my $i (0 .. $#{$case->{steps}}) {
		my %got = ($lines[$i] // '') =~ /Block\.(\w+)=(\S+)/g;
		my %want = %{$case->{steps}[$i]{out}};
		$want{ET} = milliseconds($want{ET}) if defined $want{ET};
		for my $pin (sort keys %want) {
			my $found = $got{$pin} // 'nothing';
			$wrong .= "call " . ($i + 1) . ": $pin is $found, not $want{$pin}\n"
				if $found ne $want{$pin};
		}
	}
	is($wrong, '', $name) or diag($case->{source});
}

my @cases = read_cases();
my $number = 0;
$_->{name} = 'X' . ++$number for @cases;
my @functions = grep { $_->{args} } @cases;
judge_functions(splice @functions, 0, $at_once) while @functions;
judge_block($_) for grep { $_->{steps} } @cases;
is(scalar @cases, 597, 'the number of cases');
done_testing();
