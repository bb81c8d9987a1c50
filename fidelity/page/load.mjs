/** Models by three.js's own loaders, as scenes in their pose. */

import { AnimationMixer, Color, Float32BufferAttribute, Group, LoopOnce, Mesh, MeshLambertMaterial, SRGBColorSpace } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MTLLoader } from 'three/addons/loaders/MTLLoader.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';

const LOADERS = { gltf, glb: gltf, obj, stl, ply };

export async function load({ file, animation, time }) {
    const url = `/models/${file.split('/').map(encodeURIComponent).join('/')}`;
    const scene = await LOADERS[file.split('.').at(-1).toLowerCase()](url, animation, time);
    scene.updateMatrixWorld(true);
    // Skins take their bones' places from here when vertices are asked for.
    scene.traverse((node) => node.skeleton?.update());
    return scene;
}

async function gltf(url, animation, time) {
    const { scene, animations } = await new GLTFLoader().loadAsync(url);
    if (animation !== undefined) {
        const clip = animations.find(({ name }) => name === animation) ?? animations[animation];
        if (!clip) throw new Error(`no animation ${animation}`);
        const mixer = new AnimationMixer(scene);
        const action = mixer.clipAction(clip);
        action.setLoop(LoopOnce);
        action.clampWhenFinished = true;
        action.play();
        mixer.setTime(time);
    }
    return scene;
}

async function obj(url) {
    const text = await (await fetch(url)).text();
    const loader = new OBJLoader();
    const library = text.match(/^mtllib\s+(.+?)\s*$/m)?.[1];
    const folder = url.slice(0, url.lastIndexOf('/') + 1);
    const found = library && await fetch(folder + encodeURIComponent(library));
    if (found?.ok) {
        const materials = new MTLLoader().parse(await found.text(), folder);
        const loaded = Promise.all(Object.keys(materials.materialsInfo).map((name) => settled(materials, name)));
        loader.setMaterials(materials);
        await loaded;
    }
    const scene = loader.parse(text);
    scene.traverse((node) => {
        if (node.material) for (const material of [node.material].flat()) material.side = 2;
    });
    return scene;
}

/** MTLLoader tells nobody when its textures are there. */
async function settled(materials, name) {
    const { map } = materials.create(name);
    while (map && !map.image?.complete) await new Promise((resolve) => setTimeout(resolve, 10));
}

async function stl(url) {
    const geometry = await new STLLoader().loadAsync(url);
    // Facets are flat, whatever normals the file gives them; the conventions know no colours of STL.
    for (const name of ['normal', 'color']) geometry.deleteAttribute(name);
    return plain(geometry);
}

async function ply(url) {
    const bytes = await (await fetch(url)).arrayBuffer();
    const header = new TextDecoder('latin1').decode(bytes.slice(0, 4096)).split('end_header')[0];
    const loader = new PLYLoader();
    // The loader's own conversion to linear light rounds it to bytes: take the codes as they are.
    const isColoured = /^property uchar red\s*$/m.test(header);
    if (isColoured) loader.setCustomPropertyNameMapping({ codes: ['red', 'green', 'blue'] });
    const geometry = loader.parse(bytes);
    geometry.deleteAttribute('color');
    if (isColoured) {
        const codes = geometry.getAttribute('codes');
        geometry.deleteAttribute('codes');
        const color = new Color();
        const linear = [];
        for (let i = 0; i < codes.count; i++) {
            color.setRGB(codes.getX(i) / 255, codes.getY(i) / 255, codes.getZ(i) / 255, SRGBColorSpace);
            linear.push(color.r, color.g, color.b);
        }
        geometry.setAttribute('color', new Float32BufferAttribute(linear, 3));
    }
    return plain(geometry);
}

/** White unless coloured, double sided. */
function plain(geometry) {
    const material = new MeshLambertMaterial({ side: 2, vertexColors: geometry.hasAttribute('color') });
    return new Group().add(new Mesh(geometry, material));
}
