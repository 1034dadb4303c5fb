#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# golden.t - runs every case of tests/golden and compares byte by byte.
#
# A case is a folder with main.rung, or with make.pl that writes a large one, and at least one
# of
#   expected.diag   standard error of `ladder check`
#   expected.il     output of `ladder il`
#   expected.trace  output of `ladder trace main.rung stimulus`
#   expected.why    output of `ladder why main.rung stimulus COIL` for each line in `ask`
#   expected.show   output of `ladder show main.rung`; expected.ascii: with --ascii
#   expected.ladder output of `ladder export --as ld`, and its messages
#   expected.st     output of `ladder export --as st`, and its messages; expected.lists: --as il;
#                   expected.networks: --as fbd; the file `pous` names those that are converted
#   expected.classic output of `ladder export --as classicladder`, and its messages;
#                   expected.numeric: --as numeric
#   expected.test   standard error of `ladder test main.scn`
#   expected.fault  trace and messages of a program that ends with a fault
# The cases together must show every message of diag.def and trace every word of
# catalog.def. `--bless CASE` rewrites the expected files of a case and shows the difference
# for a person to read. With LADDER_BATCH, a command that starts ladder_batch, all commands
# run in that one process: an emulator then starts once.
use strict;
use warnings;
use Cwd qw(abs_path getcwd);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir tempfile);
use IPC::Open2;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $engine = "$tests/../runtime/engine";
my $ladder = abs_path($ENV{LADDER} || "$tests/../build/ladder");

my %command = (
	diag  => ['check', 'main.rung'],
	test  => ['test', 'main.scn'],
	il    => ['il', 'main.rung'],
	trace => ['trace', 'main.rung', 'stimulus'],
	fault => ['trace', 'main.rung', 'stimulus'],
	ladder => ['export', '--as', 'ld', 'main.rung'],
	st => ['export', '--as', 'st', 'main.rung'],
	lists => ['export', '--as', 'il', 'main.rung'],
	networks => ['export', '--as', 'fbd', 'main.rung'],
	classic => ['export', '--as', 'classicladder', 'main.rung'],
	numeric => ['export', '--as', 'numeric', 'main.rung'],
	show  => ['show', 'main.rung'],
	ascii => ['show', '--ascii', 'main.rung'],
	why   => [],
);

# The folder with the files of a case.
my %made;
sub place_of {
	my ($dir) = @_;
	return $dir unless -e "$dir/make.pl";
	$made{$dir} //= do {
		my $place = tempdir(CLEANUP => 1);
		system "cd '$place' && '$^X' '$dir/make.pl'" and die "$dir/make.pl: $?\n";
		$place;
	};
	return $made{$dir};
}

# Exit status of a command in the folder $place.
my ($batch, $batch_in, $batch_out);
sub run_in_batch {
	my ($place, @words) = @_;
	$batch //= open2($batch_out, $batch_in, $ENV{LADDER_BATCH});
	print $batch_in join("\t", $place, @words), "\n";
	my $status = <$batch_out>;
	die "$ENV{LADDER_BATCH} has ended\n" unless defined $status;
	return 0 + $status;
}

sub run_alone {
	my ($place, $out_name, $err_name, @args) = @_;
	my $pid = fork;
	die "fork: $!" unless defined $pid;
	if (!$pid) {
		chdir $place or exit 126;
		open STDIN, '<', '/dev/null';
		open STDOUT, '>', $out_name;
		open STDERR, '>', $err_name;
		exec $ladder, @args or exit 127;
	}
	waitpid $pid, 0;
	return $? & 127 ? -1 : $? >> 8;
}

# Runs one command of a case in its folder: standard output, error, exit status.
sub run_case {
	my ($dir, @args) = @_;
	my (undef, $out_name) = tempfile(UNLINK => 1);
	my (undef, $err_name) = tempfile(UNLINK => 1);
	my $run = $ENV{LADDER_BATCH} ? \&run_in_batch : \&run_alone;
	my $status = $run->(place_of($dir), $out_name, $err_name, @args);
	return (slurp($out_name), slurp($err_name), $status);
}

# The answers of several runs; the last status is that of all, if they agree.
sub produce_why {
	my ($dir) = @_;
	my ($text, $worst) = ('', 0);
	for my $coil (split /\n/, slurp("$dir/ask")) {
		my ($out, $err, $status) = run_case($dir, 'why', 'main.rung', 'stimulus', $coil);
		$text .= "$out$err";
		$worst = $status if $status > $worst;
	}
	my $wanted = $text =~ /: error LD/ ? 1 : 0;
	return ($text, $worst == $wanted, $worst);
}

# The present text of an expected file, and whether the exit status is right.
sub produce {
	my ($dir, $kind) = @_;
	return produce_why($dir) if $kind eq 'why';
	my @pous = -e "$dir/pous" && $command{$kind}[0] eq 'export' ? split ' ', slurp("$dir/pous") : ();
	my ($out, $err, $status) = run_case($dir, @{$command{$kind}}, @pous);
	my $text = $kind =~ /^(?:diag|test)$/ ? $err : $kind =~ /fault|ladder|^st$|lists|networks|classic|numeric/ ? "$out$err" : $out;
	my $wanted = $kind eq 'fault' || ($kind =~ /diag|^test|^st$|lists|networks|ladder|classic|numeric/ && $err =~ /: error LD/) ? 1 : 0;
	return ($text, $status == $wanted, $status);
}

sub cases {
	return sort map { dirname($_) } glob("$tests/golden/*/{main.rung,make.pl}");
}

sub bless_case {
	my ($dir) = @_;
	my @kinds = grep { -e "$dir/expected.$_" } sort keys %command;
	push @kinds, 'trace' if -e "$dir/stimulus" && !grep { /trace|fault/ } @kinds;
	@kinds = ('diag') unless @kinds;
	for my $kind (@kinds) {
		my ($text, $good, $status) = produce($dir, $kind);
		my $path = "$dir/expected.$kind";
		my ($new, $new_name) = tempfile(UNLINK => 1);
		binmode $new;
		print $new $text;
		close $new;
		print "$path: exit status $status\n" unless $good;
		system 'diff', '-u', '-N', '--label', "$path (before)", '--label',
			"$path (now)", $path, $new_name;
		open my $to, '>:raw', $path or die "$path: $!\n";
		print $to $text;
		close $to or die "$path: $!\n";
	}
}

if (@ARGV && $ARGV[0] eq '--bless') {
	shift;
	die "which case? make bless CASE=name\n" unless @ARGV;
	for my $name (@ARGV) {
		grep { $_ eq "$tests/golden/$name" } cases() or die "no case $name\n";
		bless_case("$tests/golden/$name");
	}
	exit 0;
}

# A case counts for a word if it runs there, in a file that is traced.
sub traced_text {
	my $text = '';
	for my $dir (cases()) {
		$text .= slurp("$dir/main.rung") if -e "$dir/expected.trace";
	}
	$text =~ s/\(\*.*?\*\)//gs;
	$text =~ s/"[^"\n]*"//g;
	return $text;
}

# The form of a word in a rung file; undef: it cannot be written.
sub pattern {
	my ($kind, $id, $word) = @_;
	return qr/:\s*\Q$id\E\b/ if $kind eq 'TYPE';
	return qr/^\s*(?:\w+:\s*)?\Q$id\E(?:C|N|CN)?\b(?!\s*:)/m if $kind eq 'OP';
	return qr/\|\s*\Q$id\E\s/ if $kind ne 'ELEM';
	return undef if $word eq '';
	return qr/\|\s*\[(?![^\]]*:=)/ if $word eq '[ ]';
	return qr/\|\s*\[[^\]]*:=/ if $word eq '[:=]';
	return qr/\|\s*\.\w/ if $word eq '.';
	return qr/\|\s*\Q$word\E[\s|]/;
}

sub missing_words {
	my $traced = traced_text();
	my @missing;
	for my $row (split /\n/, slurp("$engine/catalog.def")) {
		next unless $row =~ /^(?:MORE_)?(TYPE|ELEM|FB|FN|OP)\((\w+),\s*(?:"([^"]*)")?/;
		my ($kind, $id, $word) = ($1, $2, defined $3 ? $3 : '');
		next if $id eq 'id';
		my $pattern = pattern($kind, $id, $word);
		push @missing, "$kind $id" if defined $pattern && $traced !~ $pattern;
	}
	return @missing;
}

# These messages cannot come from a rung file: of the system (LD0), of names in
# scripts (LD327), of ladderd only (LD316: tests/hal/retain.t), of I/O maps (LD5), of code
# images (LD61).
my $elsewhere = qr/^LD(?:0|8|316|327|5|61|606|607)/;
# These come from the library only: the programs read the plant before the scenario.
my %in_library = (LD135 => 'unit/trial/test_scenario.c');

sub missing_codes {
	my $shown = join '', map { my $dir = $_; map { slurp("$dir/expected.$_") // '' }
		qw(diag test st lists networks ladder classic numeric) } cases();
	$shown .= slurp("$tests/bad/st.cases"); # of IEC text: bad_st.t
	slurp("$tests/$in_library{$_}") =~ /"$_:\d/ and $shown .= " $_: " for keys %in_library;
	my @codes = slurp("$engine/diag.def") =~ /^DIAG\(\w+,\s*"(LD\d+)"/mg;
	return grep { !/$elsewhere/ && $shown !~ / $_: / } @codes;
}

# Without libxml2 a PLCopen project is only named (LD040); plcopen.t looks at that.
my $reads_xml = (run_case("$tests/golden/diag-LD740-xml-damaged", @{$command{diag}}))[1] !~ /LD040/;

for my $dir (cases()) {
	my $name = basename($dir);
	my @kinds = grep { -e "$dir/expected.$_" } sort keys %command;
	next if $name =~ /^diag-LD\d+-xml-/ && !$reads_xml;
	ok(@kinds > 0, "$name expects something");
	for my $kind (@kinds) {
		my ($text, $good, $status) = produce($dir, $kind);
		is($text, slurp("$dir/expected.$kind"), "$name: $kind");
		ok($good, "$name: $kind: exit status $status");
	}
}
if ($batch) {
	close $batch_in;
	waitpid $batch, 0;
	is($?, 0, 'ladder_batch ended well');
}
is_deeply([missing_codes()], [], 'every message has a case');
is_deeply([missing_words()], [], 'every word has a traced case');
done_testing();
