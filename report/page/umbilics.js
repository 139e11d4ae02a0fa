// SPDX-License-Identifier: LGPL-2.1-or-later
// A model in space with its umbilics. Without WebGL the page keeps its still pictures.
(function () {
  'use strict';

  const scene = JSON.parse(document.getElementById('scene').textContent);
  const figure = document.querySelector('.viewer');
  const size = scene.diagonal || 1;

  // A face that is chosen shows its section; a section that is opened shows its face.
  let select = () => {};
  document.querySelectorAll('.face-section').forEach(section => {
    section.addEventListener('toggle', () => { if (section.open) select(Number(section.id.slice(5))); });
  });
  window.addEventListener('beforeprint', () => {
    document.querySelectorAll('.face-section').forEach(section => { section.open = true; });
  });

  const stage = makeStage(figure, size);
  if (!stage) return;
  const { world, canvas, unpack, geometryOf, edgesOf, faceAt, render } = stage;

  const colors = { shown: new THREE.Color(0xc9d6e2), region: new THREE.Color(0xe4dccb), plain: new THREE.Color(0xd9dbde) };
  const chosen = new THREE.Color(0xf0d27a);
  const triangles = unpack(scene.mesh.triangles, Uint32Array);
  const starts = unpack(scene.mesh.faces, Uint32Array);

  // Faces do not share vertices, so each has a colour of its own.
  const geometry = geometryOf(scene.mesh);
  const vertexColors = new Float32Array(geometry.getAttribute('position').count * 3);
  geometry.setAttribute('color', new THREE.BufferAttribute(vertexColors, 3));
  function paint(number, color) {
    for (let i = 0; i < starts.length; i += 2) {
      if (starts[i] !== number) continue;
      const end = i + 3 < starts.length ? starts[i + 3] : triangles.length / 3;
      for (let k = 3 * starts[i + 1]; k < 3 * end; ++k) color.toArray(vertexColors, 3 * triangles[k]);
    }
    geometry.getAttribute('color').needsUpdate = true;
  }
  const plainColor = number => colors[scene.faces[number] || 'plain'];
  for (let i = 0; i < starts.length; i += 2) paint(starts[i], plainColor(starts[i]));

  const model = new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({
    specular: 0x4a4a4a, shininess: 18, vertexColors: THREE.VertexColors,
    side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1
  }));
  const edges = edgesOf(scene.mesh, geometry);
  world.add(model, edges);

  let current = 0;
  select = number => {
    if (current) paint(current, plainColor(current));
    current = number;
    paint(number, chosen);
    render();
  };

  /** The mark of a type as a picture that keeps its size on the screen. */
  function markMaterial(type, pale) {
    const side = 64;
    const picture = document.createElement('canvas');
    picture.width = picture.height = side;
    const context = picture.getContext('2d');
    context.translate(side / 2, side / 2);
    context.scale(side / 2.8, side / 2.8);
    context.globalAlpha = pale ? 0.4 : 1;
    const path = new Path2D(scene.types[type].path);
    context.lineJoin = 'round';
    context.lineWidth = 0.5;
    context.strokeStyle = '#ffffff';
    context.stroke(path);
    context.fillStyle = scene.types[type].color;
    context.fill(path);
    return new THREE.SpriteMaterial({
      map: new THREE.CanvasTexture(picture), sizeAttenuation: false, depthTest: true, alphaTest: 0.05
    });
  }

  const marks = new THREE.Group(), outside = new THREE.Group();
  const glyphs = [];
  const materials = {};
  scene.umbilics.forEach(umbilic => {
    const group = umbilic.outside ? outside : marks;
    const key = umbilic.type + umbilic.outside;
    materials[key] = materials[key] || markMaterial(umbilic.type, umbilic.outside);
    const glyph = new THREE.Sprite(materials[key]);
    glyph.position.fromArray(umbilic.point);
    glyph.scale.setScalar(0.025);
    glyph.userData = { text: umbilic.label, point: glyph.position.clone(), face: umbilic.face, outside: umbilic.outside };
    glyphs.push(glyph);
    group.add(glyph);
    const ends = [];
    umbilic.directions.forEach(direction => {
      const reach = new THREE.Vector3().fromArray(direction).multiplyScalar(0.03 * size);
      ends.push(glyph.position.clone().add(reach), glyph.position.clone().sub(reach));
    });
    if (!umbilic.outside) group.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(ends),
      new THREE.LineBasicMaterial({ color: scene.types[umbilic.type].color })));
  });
  scene.curves.forEach(points => {
    const curve = new THREE.BufferGeometry().setFromPoints(points.map(point => new THREE.Vector3().fromArray(point)));
    marks.add(new THREE.Line(curve, new THREE.LineBasicMaterial({ color: 0xb03a7a, linewidth: 2 })));
  });
  world.add(marks, outside);

  // Marks come towards the viewer, along their line of sight, so that no surface cuts them in half.
  const sight = new THREE.Vector3();
  world.onBeforeRender = (renderer, scene, camera) => {
    glyphs.forEach(glyph => {
      sight.copy(camera.position).sub(glyph.userData.point);
      glyph.position.copy(glyph.userData.point).addScaledVector(sight, 0.02);
      glyph.updateMatrixWorld();
    });
  };

  function checked(name) {
    const input = figure.querySelector('input[name=' + name + ']');
    return input ? input.checked : name !== 'outside';
  }

  function toggle() {
    marks.visible = checked('umbilics');
    outside.visible = marks.visible && checked('outside');
    edges.visible = checked('edges');
    render();
  }

  function shownGlyphs() {
    return glyphs.filter(glyph => marks.visible && (!glyph.userData.outside || outside.visible));
  }

  function faceOf(hit) {
    return hit.object.userData.face || faceAt(scene.mesh, hit.faceIndex);
  }

  // A drag turns the model; only a click on one spot chooses.
  let pressed = null;
  canvas.addEventListener('mousedown', event => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener('mouseup', event => {
    if (!pressed || Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
    stage.aim(event);
    const hit = stage.ray.intersectObjects(shownGlyphs()).concat(stage.ray.intersectObject(model))[0];
    if (!hit) return;
    const number = faceOf(hit);
    select(number);
    const section = document.getElementById('face-' + number);
    if (!section) return;
    section.open = true;
    section.scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  });

  stage.describe(shownGlyphs, [model], hit => hit.object.userData.text || 'Face ' + faceOf(hit));
  figure.querySelectorAll('input').forEach(input => input.addEventListener('change', toggle));
  figure.querySelector('button[name=reset]').addEventListener('click', () => stage.look(new THREE.Box3().setFromObject(model)));

  stage.resize();
  toggle();
  stage.look(new THREE.Box3().setFromObject(model));
})();
