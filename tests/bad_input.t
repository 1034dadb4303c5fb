#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# bad_input.t - every word has a case for every kind of bad input, and its result is in a file.
# The programs are made from the rows of the catalogue, so a word without cases fails here:
# `tests/bad_input.t --write` writes them, `make bless CASE=…` writes the expected results, and
# a person reads the difference.
#
#   tests/golden/bad-values-FAMILY   results, power and errors of difficult values
#   tests/golden/bad-types-FAMILY    a wrong type at each pin
#   tests/golden/bad-range-FAMILY    constants beyond the range of their type
#   tests/golden/bad-deepest         all kinds of nesting, as deep as allowed
#   tests/golden/bad-fault-*         programs that never end; these are written by hand
#   tests/bad/deepest.table          the message about one level more of each kind
#   tests/bad/types.table            every pin with every type: refused types and messages
#   tests/bad/pins.table             pins missing, unknown, twice, in the wrong direction
#   tests/bad/operands.table         every element and operator with operands of each kind
#
# golden.t compares the results of the cases; here the cases also run in the build with
# sanitizers, and each value that did not give power must have been counted as an error.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib map { abs_path(dirname(__FILE__)) . $_ } '', '/bad';
use Deepest;
use Files;
use Refused;
use Rows;
use Traced;

my $tests = abs_path(dirname(__FILE__));
my $build = $ENV{BUILD} // "$tests/../build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
# An old build with sanitizers would test another program.
my $sanitized = -x "$build/asan/ladder" && -M "$build/asan/ladder" <= -M $ladder;
my $runner = $sanitized ? abs_path("$build/asan/ladder") : $ladder;
my $folder = tempdir(CLEANUP => 1);
my $write = @ARGV && $ARGV[0] eq '--write';
my $at_once = 40; # a file shows only 100 messages

my $words = decode_json((answer($folder, $ladder, 'words', '--json'))[1]);
my @functions = Rows::functions("$tests/../runtime/engine/catalog.def");
my @blocks = grep { $_->{kind} eq 'function block' } @$words;
my %limits = Deepest::limits("$tests/../runtime/engine/base/limits.h");
my (%function_family, %block_family);
push @{$function_family{lc $_->{family}}}, $_ for @functions;
push @{$block_family{lc $_->{family}}}, $_ for @blocks;

# Every generated case: its name, and the texts of its files.
sub cases {
	my %case;
	for my $family (sort keys %function_family) {
		my @rows = @{$function_family{$family}};
		$case{"bad-values-$family"} = { Traced::functions($family, @rows) };
		my %static = Refused::family($family,
			map { my $row = $_; sub { Refused::of_function($row) } } @rows);
		$case{"bad-$_-$family"} = { 'main.rung' => $static{$_} } for keys %static;
	}
	for my $family (sort keys %block_family) {
		my @rows = @{$block_family{$family}};
		$case{"bad-values-$family"} = { Traced::blocks($family, @rows) };
		my %static = Refused::family($family,
			map { my $row = $_; sub { Refused::of_block($row) } } @rows);
		$case{"bad-$_-$family"} = { 'main.rung' => $static{$_} } for keys %static;
	}
	$case{'bad-deepest'} = { 'main.rung' => Deepest::program(%limits),
		'stimulus' => "\@print Calls Expr List Rounds Nested Sum Wide Last SYS_ERRORS\n.\n.\n" };
	return %case;
}

# The first message of a program, without its name; or "good".
sub first_message {
	my ($text) = @_;
	my ($message) = $text =~ /^\S+ (?:rung .*?\) |.*?: )?error (LD\d+: .*)$/m;
	return 'good' if !defined $message;
	$message =~ s/"[^"]*"/"…"/g; # the name, so that the message is the same for all operands
	return $message;
}

# Prints blocks of text; words with the same block are listed together.
sub joined {
	my (@pairs) = @_;
	my (%words_of, @order);
	for my $pair (@pairs) {
		push @order, $pair->[1] if !$words_of{$pair->[1]};
		push @{$words_of{$pair->[1]}}, $pair->[0];
	}
	return join '', map { "@{$words_of{$_}}\n$_" } @order;
}

# The messages about programs with one error: lines "message: error".
sub said_to {
	my ($between, @cases) = @_;
	my (%said, @order);
	for my $case (@cases) {
		spew("$folder/main.rung", $case->[1]);
		my ($status, $text) = answer($folder, $ladder, 'check', 'main.rung');
		my $message = $status & 127 ? "signal $status" : first_message($text);
		push @order, $message if !$said{$message};
		push @{$said{$message}}, $case->[0];
	}
	return join '', map { "  $_: " . join($between, @{$said{$_}}) . "\n" } @order;
}

# "WORD  message: operands" for each element and operator.
sub operands_table {
	my %named = (element => 'ladder:', 'IL operator' => 'list:');
	return joined(map { ["$named{$_->{kind}}$_->{word}",
		said_to(' ', Refused::with_operands($_))] }
		grep { $named{$_->{kind}} } @$words);
}

# "WORD  message: error" for the pins of each function and block.
sub pins_table {
	return joined(map { my $word = $_->{result} ? Refused::of_function($_) : Refused::of_block($_);
		[$_->{word}, said_to(', ', map { my ($wrong, $rung) = @$_;
			[$wrong, Refused::program('pins', $word->{declared}->(), $rung)]
		} Refused::wrong_pins($word))] } @functions, @blocks);
}

# The message about one level more than the limit, for each kind of nesting.
sub deepest_table {
	return joined(map { [$_, said_to('', ["$limits{$_} is the limit, " . ($limits{$_} + 1) .
		' are too many', Deepest::program($_ => $limits{$_} + 1)])] } sort keys %limits);
}

# The messages of many rungs, by rung number.
sub judge {
	my ($word, @rungs) = @_;
	my %said;
	spew("$folder/main.rung", Refused::program('types', $word->{declared}->(), @rungs));
	my ($status, $text) = answer($folder, $ladder, 'check', 'main.rung');
	for my $line (split /\n/, $text) {
		$said{$1 - 1} //= $2 if $line =~ /: rung (\d+) .*error (LD\d+)/;
	}
	return %said;
}

# "WORD PIN  code: types" for each pin of each function and block.
sub types_table {
	my @table;
	for my $row (@functions, @blocks) {
		my $name = $row->{word};
		my $word = $row->{result} ? Refused::of_function($row) : Refused::of_block($row);
		my @all = Refused::all_types($word);
		my (%refused, @order);
		while (my @some = splice @all, 0, $at_once) {
			my %said = judge($word, map { $_->[0] } @some);
			for my $i (grep { $said{$_} } 0 .. $#some) {
				my $key = "$some[$i][1] $said{$i}";
				push @order, $key if !$refused{$key};
				push @{$refused{$key}}, $some[$i][2];
			}
		}
		push @table, [$name, join '', map { "  $_: @{$refused{$_}}\n" } @order];
	}
	return joined(@table);
}

# Compares the counted errors with the powers in the trace of functions. A result of type
# BOOL may also give no power because of its value. Without EN nothing runs and nothing is
# counted.
sub count_errors {
	my ($program, $trace) = @_;
	my %is_bool = map { $_ => 1 } $program =~ /^  r_(\w+) : BOOL;/mg;
	my ($before, $least, $most, $off, $odd) = (0, 0, 0, 0, '');
	for my $line (split /\n/, $trace) {
		$off = $line =~ /^# EN FALSE/ if $line =~ /^#/;
		next unless $line =~ /SYS_ERRORS=(\d+)/;
		my $grown = $1 - $before;
		$odd .= "$line\n" if $grown < $least || $grown > $most;
		$before = $1;
		my @failed = $off ? () : $line =~ / ok_(\w+)=0/g;
		$least = grep { !$is_bool{$_} } @failed;
		$most = @failed;
	}
	return $odd;
}

my %case = cases();
my %table = ('types.table' => \&types_table, 'pins.table' => \&pins_table,
	'deepest.table' => \&deepest_table,
	'operands.table' => \&operands_table);
if ($write) {
	for my $name (sort keys %case) {
		mkdir "$tests/golden/$name";
		spew("$tests/golden/$name/$_", $case{$name}{$_}) for keys %{$case{$name}};
	}
	spew("$tests/bad/$_", $table{$_}->()) for sort keys %table;
	print "make bless CASE='", join(' ', sort keys %case), "'\n";
	exit 0;
}

diag('without sanitizers: make asan') if !$sanitized;
is(scalar(grep { $_->{kind} eq 'function' } @$words), scalar @functions,
	'every function has a row that is read here');
for my $name (sort keys %case) {
	my $dir = "$tests/golden/$name";
	is(slurp("$dir/$_"), $case{$name}{$_}, "$name: $_ is what the catalogue asks for")
		for sort keys %{$case{$name}};
	my $kind = $case{$name}{stimulus} ? 'trace' : 'diag';
	my $expected = slurp("$dir/expected.$kind");
	isnt($expected, undef, "$name: expects something") or next;
	my ($status, $text) = answer($dir, $runner, $kind eq 'trace' ?
		('trace', 'main.rung', 'stimulus') : ('check', 'main.rung'));
	$text =~ s/^main\.rung: \d+ errors?(?:, \d+ warnings?)?\n//m;
	$text =~ s/^.*: warning LD.*\n//mg if $kind eq "trace";
	is($text, $expected, "$name: the same with sanitizers") if $sanitized;
	next if $kind eq 'diag';
	ok($status == 0, "$name: runs");
	is(count_errors($case{$name}{'main.rung'}, $expected), '', "$name: each error is counted once")
		if $expected =~ /ok_/;
}
for my $dir (glob "$tests/golden/bad-fault-*") {
	my ($status, $text) = answer($dir, $runner, 'trace', 'main.rung', 'stimulus');
	my %lines = map { $_ => 1 } split /\n/, $text;
	is_deeply([grep { !$lines{$_} } split /\n/, slurp("$dir/expected.fault")], [],
		basename($dir) . ': the same with sanitizers');
}
is($table{$_}->(), slurp("$tests/bad/$_"), "$_: what is refused, and why") for sort keys %table;

# A message says REF( ) with as much of a long name as has room: whole letters, and the end of the parentheses.
my $letter = "\xc3\xa4";
my @long = map { my $lead = $_; map { my $count = $_; map { $lead . 'B' . $_ x $count } 'a', $letter } 20 .. 40, 50 .. 70, 120 } '', 'x';
my @odd;
for my $name (@long) {
	spew("$folder/ref.rung", "RUNGBOARD 1\nVAR\n  $name : INT;\nEND_VAR\nPROGRAM M IL\n  R REF($name)\nEND_PROGRAM\n");
	my ($status, $text) = answer($folder, $runner, 'check', 'ref.rung');
	my ($said, $end) = $text =~ /error LD603: "REF\((x?B(?:a|$letter)*)(.*?)": /;
	push @odd, $name if !defined $said || $end ne ')' || index($name, $said) != 0 || length $said < (length $name < 57 ? length $name : 57);
}
is_deeply(\@odd, [], scalar(@long) . ' long names in REF( ) are told');
done_testing();
