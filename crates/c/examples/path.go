// A path at any angle, in Go:
//
//	CGO_CFLAGS=-I../include CGO_LDFLAGS="-LFOLDER -lmediant" go run path.go
package main

/*
#include <mediant.h>
#include <stdlib.h>
*/
import "C"

import (
	"errors"
	"fmt"
	"log"
	"runtime"
	"unsafe"
)

// The message is that of a thread: a goroutine that asks for it stays on its thread until it has it.
func do(call func() C.mediant_code) error {
	runtime.LockOSThread()
	defer runtime.UnlockOSThread()
	if call() != C.MEDIANT_CODE_OK {
		return errors.New(C.GoString(C.mediant_message()))
	}
	return nil
}

func run() error {
	var m C.mediant_map
	rows := C.CString("......\n.@@@@.\n......\n")
	defer C.free(unsafe.Pointer(rows))
	if err := do(func() C.mediant_code { return C.mediant_map_parse(rows, &m) }); err != nil {
		return err
	}
	defer C.mediant_map_free(m)
	var space C.mediant_space
	motion := C.CString("k=any gap=closed")
	defer C.free(unsafe.Pointer(motion))
	if err := do(func() C.mediant_code { return C.mediant_space_new(m, motion, &space) }); err != nil {
		return err
	}
	defer C.mediant_space_free(space)
	var index C.mediant_index
	if err := do(func() C.mediant_code { return C.mediant_index_prepare(space, nil, nil, &index) }); err != nil {
		return err
	}
	defer C.mediant_index_free(index)
	var planner C.mediant_planner
	if err := do(func() C.mediant_code { return C.mediant_planner_new(index, &planner) }); err != nil {
		return err
	}
	defer C.mediant_planner_free(planner)

	points := make([]C.mediant_point, 100)
	var count C.size_t
	var length C.double
	start, goal := C.mediant_point{x: 0, y: 0}, C.mediant_point{x: 6, y: 2}
	if err := do(func() C.mediant_code {
		return C.mediant_planner_path(planner, start, goal, &points[0], C.size_t(len(points)), &count, &length)
	}); err != nil {
		return err
	}
	fmt.Printf("%d points, length %.3f\n", count, length)
	// The count may be more than there is room for.
	for i := 0; i < int(count) && i < len(points); i++ {
		fmt.Printf("(%g, %g)\n", points[i].x, points[i].y)
	}
	return nil
}

func main() {
	if err := run(); err != nil {
		log.Fatal(err)
	}
}
